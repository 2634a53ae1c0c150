// SPDX-License-Identifier: Apache-2.0
// What decides about the bytes of a map decides about its key, and nothing else does.
#include "tile/setup_key.h"

#include <gtest/gtest.h>

#include <functional>
#include <set>
#include <string>

#include "support/checkpoint_case.h"

namespace pdsm::test {
namespace {

struct Bake {
  Scene scene = checkpoint_scene();
  Light light = checkpoint_light();
  BakeOptions options = checkpoint_options();

  [[nodiscard]] std::string key() const {
    const BakeJob job(scene, light, options);
    return setup_key(job, light, job.options.isa);
  }
};

void change_mesh(Bake& bake, const std::function<void(Mesh&)>& change) {
  Mesh mesh = *bake.scene.geometry[1].mesh;
  change(mesh);
  bake.scene.geometry[1].mesh = std::make_shared<const Mesh>(std::move(mesh));
}

/// A mask on a mesh of the scene, spoilt in one way a test.
void cut_out(Bake& bake, const std::function<void(Mesh&, CutoutMask&)>& change) {
  change_mesh(bake, [&](Mesh& mesh) {
    CutoutMask mask{4, 2, {0, 1, 2, 3, 4, 5, 6, 7}, {}, 0.5F};
    mesh.closed = false;
    mesh.mask_places.assign(mesh.positions.size(), glm::vec2(0.5F));
    change(mesh, mask);
    mesh.mask = std::make_shared<const CutoutMask>(mask);
  });
}

/// The key after a change.
std::string after(const std::function<void(Bake&)>& change) {
  Bake bake;
  change(bake);
  return bake.key();
}

TEST(SetupKey, ChangesWithWhatDecides) {
  const std::vector<std::function<void(Bake&)>> changes{
      [](Bake& b) { b.light.name = "other"; },
      [](Bake& b) { b.options.samples = 9; },
      [](Bake& b) { b.options.seed = 1; },
      [](Bake& b) { b.options.points = PointSet::jittered; },
      [](Bake& b) { b.options.width = 151; },
      [](Bake& b) { b.options.map_height = 258; },
      [](Bake& b) { b.options.epsilon = 0.03; },
      [](Bake& b) { b.options.depth_tolerance = 0.001; },
      [](Bake& b) { b.options.bias = 0.2; },
      [](Bake& b) { b.options.walk = Walk::midpoint; },
      [](Bake& b) { b.options.receivers = Receivers::all; },
      [](Bake& b) { b.options.receivers = Receivers::surfaces; },
      [](Bake& b) { b.options.mip_levels = 2; },
      [](Bake& b) { b.options.unrounded_values = true; },
      [](Bake& b) { b.options.isa = "sse2"; },
      [](Bake& b) {
        b.light.window = {-0.5, -0.4, 0.5, 0.41};
      },
      [](Bake& b) {
        b.light.shape = RectLight{1.5, 1.1};
      },
      [](Bake& b) { b.light.position.x = 0.1; },
      [](Bake& b) { b.light.near_depth = 1; },
      [](Bake& b) { b.scene.geometry[1].casts = false; },
      [](Bake& b) { b.scene.geometry[1].receives = false; },
      [](Bake& b) { b.scene.geometry[1].local_to_world[3][0] = 0.01; },
      [](Bake& b) { b.scene.geometry.pop_back(); },
      [](Bake& b) { change_mesh(b, [](Mesh& m) { m.positions[0].x += 0.01F; }); },
      [](Bake& b) { change_mesh(b, [](Mesh& m) { std::swap(m.triangles[0].x, m.triangles[0].y); }); },
      [](Bake& b) { change_mesh(b, [](Mesh& m) { m.closed = !m.closed; }); },
      [](Bake& b) { cut_out(b, [](Mesh&, CutoutMask&) {}); },
      [](Bake& b) { cut_out(b, [](Mesh& m, CutoutMask&) { m.mask_places[0].x = 0; }); },
      [](Bake& b) { cut_out(b, [](Mesh&, CutoutMask& m) { m.alpha[3] = 9; }); },
      [](Bake& b) { cut_out(b, [](Mesh&, CutoutMask& m) { std::swap(m.width, m.height); }); },
      [](Bake& b) { cut_out(b, [](Mesh&, CutoutMask& m) { m.wrap[0] = MaskWrap::clamp; }); },
      [](Bake& b) { cut_out(b, [](Mesh&, CutoutMask& m) { m.wrap[1] = MaskWrap::mirror; }); },
      [](Bake& b) { cut_out(b, [](Mesh&, CutoutMask& m) { m.cutoff = 0.4F; }); },
  };
  std::set<std::string> seen{Bake().key()};
  for (std::size_t n = 0; n < changes.size(); ++n) EXPECT_TRUE(seen.insert(after(changes[n])).second) << n;
}

TEST(SetupKey, StaysWithWhatDoesNot) {
  const std::vector<std::function<void(Bake&)>> changes{
      [](Bake& b) { b.options.threads = 3; },
      [](Bake& b) { b.options.tile = 128; },
      [](Bake& b) { b.options.memory *= 2; },
      [](Bake& b) { b.scene.source = "elsewhere"; },
      [](Bake& b) { b.scene.content_hash = 1; },
      [](Bake& b) { b.scene.lights.emplace_back(); },
      [](Bake& b) { b.scene.geometry[0].name = "plate"; },
      [](Bake& b) {
        b.scene.geometry[0].base_color = {1, 0, 0};
      },
  };
  const std::string key = Bake().key();
  for (std::size_t n = 0; n < changes.size(); ++n) EXPECT_EQ(after(changes[n]), key) << n;
}

}  // namespace
}  // namespace pdsm::test
