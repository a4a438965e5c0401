// Polygons by ear clipping: a corner that turns the polygon's way, with no other corner in its triangle, is cut off.
// Each corner keeps how far its triangle was looked through: what was not in it never will be until one of its
// neighbours is cut off. So n corners take n^2 steps, not n^3.
#include <cmath>
#include <numeric>

#include "scene/read_obj.h"

namespace brume {

namespace {

struct Point {
  double x, y;
};

// Twice the area of a triangle, above 0 where it turns to the left.
double turn(Point a, Point b, Point c) { return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x); }

// The polygon in the plane of two axes that shows most of it, turning to the left.
std::vector<Point> flattened(const std::vector<Vector3>& polygon) {
  Vector3 normal;  // Newell's
  for (std::size_t i = 0; i < polygon.size(); ++i)
    normal = normal + cross(polygon[i] - polygon[0], polygon[(i + 1) % polygon.size()] - polygon[0]);
  int axis = 0;
  for (int a = 1; a < 3; ++a)
    if (std::abs(normal[a]) > std::abs(normal[axis])) axis = a;
  const int right = (axis + 1) % 3, up = (axis + 2) % 3;
  std::vector<Point> points;
  for (const Vector3& p : polygon) points.push_back(normal[axis] < 0 ? Point{p[up], p[right]} : Point{p[right], p[up]});
  return points;
}

bool is_same(Point a, Point b) { return a.x == b.x && a.y == b.y; }

// Whether corner i of those left can be cut off. `clear` counts the first of all points that are known not to keep it
// from that.
bool is_ear(const std::vector<Point>& points, const std::vector<std::uint32_t>& left, const std::vector<bool>& is_cut,
            std::size_t i, std::size_t& clear) {
  const std::size_t n = left.size();
  const Point a = points[left[(i + n - 1) % n]], b = points[left[i]], c = points[left[(i + 1) % n]];
  if (!(turn(a, b, c) > 0)) return false;
  for (; clear < points.size(); ++clear) {
    const Point p = points[clear];
    const bool in_triangle = turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0;
    if (in_triangle && !is_cut[clear] && !is_same(p, a) && !is_same(p, b) && !is_same(p, c)) return false;
  }
  return true;
}

}  // namespace

std::vector<std::array<std::uint32_t, 3>> triangulate(const std::vector<Vector3>& polygon) {
  std::vector<std::uint32_t> left(polygon.size());
  std::iota(left.begin(), left.end(), 0u);
  std::vector<std::array<std::uint32_t, 3>> triangles;
  if (polygon.size() == 3) return {{0, 1, 2}};
  const std::vector<Point> points = flattened(polygon);
  std::vector<bool> is_cut(points.size());
  std::vector<std::size_t> clear(points.size());
  while (left.size() > 2) {
    const std::size_t n = left.size();
    std::size_t ear = 1;  // also where there is none
    for (std::size_t i = 1; i <= n; ++i)
      if (is_ear(points, left, is_cut, i % n, clear[left[i % n]])) {
        ear = i % n;
        break;
      }
    const std::uint32_t before = left[(ear + n - 1) % n], corner = left[ear], after = left[(ear + 1) % n];
    triangles.push_back({before, corner, after});
    is_cut[corner] = true;
    clear[before] = clear[after] = 0;
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(ear));
  }
  return triangles;
}

}  // namespace brume
