#include "compile/bounds_media.h"

#include <gtest/gtest.h>

#include "compile/triangles_apart.h"
#include "render/scenes.h"

namespace brume {
namespace {

ShapeDescription box() { return box_shape({-1, -1, -1}, {1, 1, 1}, "fog"); }
TriangleMeshShape& mesh_of(ShapeDescription& shape) { return std::get<TriangleMeshShape>(shape.kind); }
template <class Kind>
ShapeDescription shape_of(Kind kind) {
  ShapeDescription shape;
  shape.kind = std::move(kind);
  return shape;
}

TEST(BoundsMedia, ClosedShapesEncloseTheirInside) {
  EXPECT_TRUE(is_closed(box()));
  EXPECT_TRUE(is_closed(shape_of(SphereShape{})));
  EXPECT_TRUE(is_closed(shape_of(CylinderShape{.caps = true})));
  ShapeDescription apart = box();
  mesh_of(apart) = triangles_apart(mesh_of(apart));
  EXPECT_TRUE(is_closed(apart));
  // A box of patches.
  BilinearMeshShape patches;
  for (int i = 0; i < 8; ++i) patches.positions.push_back({1.0 * (i & 1), 1.0 * (i >> 1 & 1), 1.0 * (i >> 2)});
  patches.patches = {{0, 2, 1, 3}, {4, 5, 6, 7}, {0, 1, 4, 5}, {2, 6, 3, 7}, {0, 4, 2, 6}, {1, 3, 5, 7}};
  EXPECT_TRUE(is_closed(shape_of(patches)));
  patches.patches.pop_back();
  EXPECT_FALSE(is_closed(shape_of(patches)));
}

TEST(BoundsMedia, OpenOnesDoNot) {
  EXPECT_FALSE(is_closed(shape_of(QuadShape{})));
  EXPECT_FALSE(is_closed(shape_of(DiskShape{})));
  EXPECT_FALSE(is_closed(shape_of(CylinderShape{})));
  EXPECT_FALSE(is_closed(shape_of(CylinderShape{.phi_max = 270, .caps = true})));
  EXPECT_FALSE(is_closed(shape_of(SphereShape{.z_max = 0.5})));
  EXPECT_FALSE(is_closed(shape_of(SphereShape{.phi_max = 180})));
  ShapeDescription hole = box(), flipped = box();
  mesh_of(hole).triangles.pop_back();
  EXPECT_FALSE(is_closed(hole));
  std::swap(mesh_of(flipped).triangles[3][0], mesh_of(flipped).triangles[3][1]);
  EXPECT_FALSE(is_closed(flipped));
}

TEST(BoundsMedia, OpenSurfacesThatLightDoesNotPassBoundNone) {
  ShapeDescription shape = shape_of(QuadShape{});
  shape.outside = "fog";
  BlinnPhongMaterial glass;
  glass.refraction = constant_spectrum(0.5f);
  for (const MaterialDescription& material : {MaterialDescription(InterfaceMaterial{}),
                                              MaterialDescription(DielectricMaterial{}), MaterialDescription(glass)}) {
    shape.material = material;
    EXPECT_TRUE(bounds_media(shape));
  }
  for (const MaterialDescription& material :
       {MaterialDescription(DiffuseMaterial{}), MaterialDescription(BlinnPhongMaterial{}),
        MaterialDescription(ConductorMaterial{}), MaterialDescription(CoatedDiffuseMaterial{})}) {
    shape.material = material;
    EXPECT_FALSE(bounds_media(shape));
  }
  shape.kind = SphereShape{};
  EXPECT_TRUE(bounds_media(shape));
  shape.alpha = constant_spectrum(0.5f);
  EXPECT_FALSE(bounds_media(shape));
  shape = shape_of(SphereShape{});
  shape.inside = shape.outside = "fog";
  EXPECT_FALSE(bounds_media(shape));
}

}  // namespace
}  // namespace brume
