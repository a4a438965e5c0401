// vec3 and vec4 of F for the two C++ builds, with the operators that GLSL has built in.
// Included textually, as the kernel files are, inside the namespace of the build; F and KERNEL are the build's.
struct vec3 {
  F x, y, z;
  vec3() = default;
  KERNEL vec3(F x_, F y_, F z_) : x(x_), y(y_), z(z_) {}
};
KERNEL vec3 operator+(vec3 a, vec3 b) { return vec3(a.x + b.x, a.y + b.y, a.z + b.z); }
KERNEL vec3 operator-(vec3 a, vec3 b) { return vec3(a.x - b.x, a.y - b.y, a.z - b.z); }
KERNEL vec3 operator*(vec3 a, vec3 b) { return vec3(a.x * b.x, a.y * b.y, a.z * b.z); }
KERNEL vec3 operator*(F s, vec3 a) { return vec3(s * a.x, s * a.y, s * a.z); }
KERNEL vec3 operator*(vec3 a, F s) { return vec3(a.x * s, a.y * s, a.z * s); }
KERNEL vec3 operator-(vec3 a) { return vec3(-a.x, -a.y, -a.z); }
KERNEL F dot(vec3 a, vec3 b) { return fma(a.x, b.x, fma(a.y, b.y, a.z * b.z)); }
KERNEL vec3 cross(vec3 a, vec3 b) { return vec3(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x); }
KERNEL F length(vec3 a) { return sqrt(dot(a, a)); }
KERNEL vec3 normalize(vec3 a) { return a * (F(1.0f) / length(a)); }

struct vec4 {
  F x, y, z, w;
  vec4() = default;
  KERNEL vec4(F x_, F y_, F z_, F w_) : x(x_), y(y_), z(z_), w(w_) {}
};
