// The kernel dialect in GLSL: the names that the kernel files use, in terms of GLSL's own.
// The twins of this file are scalar.h (scalar C++) and lanes/lanes-inl.h (SIMD C++).
// A shader includes this, then declares `uint words[]`, load_u32 and load_u32_pair, then includes kernel/all.inl.
#define F float
#define I int
#define U uint
#define B bool
#define KERNEL
#define INOUT(T) inout T
// An array of 32-bit words: here its offset in the one buffer of words.
#define Words uint

float select(bool m, float a, float b) { return m ? a : b; }
int select(bool m, int a, int b) { return m ? a : b; }
uint select(bool m, uint a, uint b) { return m ? a : b; }
bool both(bool a, bool b) { return a && b; }
bool either(bool a, bool b) { return a || b; }
bool negate(bool a) { return !a; }
int to_int(float x) { return int(x); }
int floor_to_int(float x) { return int(floor(x)); }
int round_to_int(float x) { return int(roundEven(x)); }
float to_float(int x) { return float(x); }
uint as_uint(int x) { return uint(x); }
int as_int(uint x) { return int(x); }
uint float_bits(float x) { return floatBitsToUint(x); }
float bits_float(uint x) { return uintBitsToFloat(x); }
uint shift_right_by(uint x, uint bits) { return x >> bits; }
// Not GLSL's own, which compilers may take apart and add up in another order: the small part of a reduced argument
// would be lost (seen in Mesa 22.3, `precise` or not).
float product_sum(float a, float b, float c) {
  precise float sum = a * b + c;
  return sum;
}
#define fma product_sum
