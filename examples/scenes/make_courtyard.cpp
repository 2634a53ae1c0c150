// SPDX-License-Identifier: Apache-2.0
// Writes the geometry of courtyard.scene.json as OBJ files: a walled court with an arcade and a pergola
// (penumbrae that overlap), steps and columns (contact), a knot and a lattice ball (self-shadowing), and a
// fence, a spiral stair's railing and wires (parts thinner than a texel). The same bytes on every run.
//
//   make_courtyard [FOLDER]     into FOLDER, by default the current one; status 4 if a file cannot be written
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

namespace {

constexpr double kPi = std::numbers::pi;

struct Vec {
  double x = 0, y = 0, z = 0;
};
Vec operator+(Vec a, Vec b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
Vec operator-(Vec a, Vec b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
Vec operator*(Vec a, double s) {
  return {a.x * s, a.y * s, a.z * s};
}
double dot(Vec a, Vec b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
Vec cross(Vec a, Vec b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
Vec unit(Vec a) {
  return a * (1 / std::sqrt(dot(a, a)));
}
Vec turned(Vec a, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {a.x * c + a.z * s, a.y, a.z * c - a.x * s};
}

/// Closed surfaces, gathered to be written as one OBJ file. Faces run counter-clockwise seen from outside.
class Model {
 public:
  /// A box with `size`, its base's centre at `base`, turned about the vertical.
  void box(Vec base, Vec size, double angle = 0) {
    const int first = count();
    for (int i = 0; i < 8; ++i) {
      const Vec corner{(i & 1 ? 0.5 : -0.5) * size.x, (i & 2 ? 1.0 : 0.0) * size.y,
                       (i & 4 ? 0.5 : -0.5) * size.z};
      vertices_.push_back(base + turned(corner, angle));
    }
    constexpr std::array<std::array<int, 4>, 6> kSides{
        {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};
    for (const auto& s : kSides) quad(first + s[0], first + s[1], first + s[2], first + s[3]);
  }

  /// A tube about a curve. `normal_hint` tells for each point a direction that is not along the curve; for a
  /// closed curve it must come round to where it began.
  void tube(const std::vector<Vec>& curve, double radius, int sides, bool closed,
            const std::function<Vec(Vec)>& normal_hint) {
    const int first = count(), length = static_cast<int>(curve.size());
    for (int i = 0; i < length; ++i) {
      const Vec before = closed ? at(curve, i + length - 1) : curve[index(std::max(i - 1, 0))];
      const Vec after = closed ? at(curve, i + 1) : curve[index(std::min(i + 1, length - 1))];
      const Vec along = unit(after - before), hint = normal_hint(curve[index(i)]);
      const Vec n = unit(hint - along * dot(hint, along)), b = cross(along, n);
      for (int k = 0; k < sides; ++k) {
        const double angle = 2 * kPi * k / sides;
        vertices_.push_back(curve[index(i)] + (n * std::cos(angle) + b * std::sin(angle)) * radius);
      }
    }
    for (int i = 0; i < (closed ? length : length - 1); ++i) {
      const int here = first + i * sides, next = first + (i + 1) % length * sides;
      for (int k = 0; k < sides; ++k)
        quad(here + k, here + (k + 1) % sides, next + (k + 1) % sides, next + k);
    }
    if (closed) return;
    const int last = first + (length - 1) * sides;
    for (int k = 1; k + 1 < sides; ++k) {
      faces_.push_back({first, first + k + 1, first + k});
      faces_.push_back({last, last + k, last + k + 1});
    }
  }

  /// An upright round post.
  void post(Vec base, double radius, double height, int sides) {
    tube({base, base + Vec{0, height, 0}}, radius, sides, false, [](Vec) { return Vec{1, 0, 0}; });
  }

  [[nodiscard]] bool write(const std::string& path) const {
    std::FILE* file = std::fopen(path.c_str(), "wb");
    if (file == nullptr) return false;
    std::fputs("# SPDX-License-Identifier: Apache-2.0\n# Written by make_courtyard.\n", file);
    for (const Vec& v : vertices_) std::fprintf(file, "v %.5f %.5f %.5f\n", v.x, v.y, v.z);
    for (const auto& f : faces_) std::fprintf(file, "f %d %d %d\n", f[0] + 1, f[1] + 1, f[2] + 1);
    const bool good = std::ferror(file) == 0;
    std::printf("%s: %zu triangles\n", path.c_str(), faces_.size());
    return std::fclose(file) == 0 && good;
  }

 private:
  static std::size_t index(int i) { return static_cast<std::size_t>(i); }
  static Vec at(const std::vector<Vec>& curve, int i) { return curve[index(i) % curve.size()]; }
  [[nodiscard]] int count() const { return static_cast<int>(vertices_.size()); }
  void quad(int a, int b, int c, int d) {
    faces_.push_back({a, b, c});
    faces_.push_back({a, c, d});
  }

  std::vector<Vec> vertices_;
  std::vector<std::array<int, 3>> faces_;
};

/// `count` points of a curve over [0, 1], both ends or, for a closed one, all but the last.
std::vector<Vec> sample(int count, bool closed, const std::function<Vec(double)>& point) {
  std::vector<Vec> curve;
  for (int i = 0; i < count; ++i)
    curve.push_back(point(static_cast<double>(i) / (closed ? count : count - 1)));
  return curve;
}

void add_arcade(Model& model) {
  // Walls on two sides, an arcade before one of them, and beams from it to the wall at three heights.
  model.box({0, 0, -6.15}, {13, 2.6, 0.3});
  model.box({-6.35, 0, 0}, {0.3, 1.7, 12});
  for (int i = 0; i < 6; ++i) {
    const double x = -5 + 2 * i;
    model.box({x, 0, -3.4}, {0.62, 0.16, 0.62});
    model.post({x, 0.16, -3.4}, 0.2, 2.6, 40);
    model.box({x, 2.76, -3.4}, {0.56, 0.14, 0.56});
  }
  model.box({0, 2.9, -3.4}, {10.8, 0.22, 0.4});
  for (int i = 0; i < 18; ++i) model.box({-5.1 + 0.6 * i, 3.12, -4.7}, {0.09, 0.14, 3.1});
  for (int i = 0; i < 6; ++i) model.box({0, 3.26, -5.8 + 0.45 * i}, {10.8, 0.05, 0.05});
}

void add_blocks(Model& model) {
  // Steps to a platform in a corner, blocks that lean on nothing but the floor, two shelves in the air.
  for (int i = 0; i < 4; ++i) model.box({-5.2 + 0.2 * i, 0.18 * i, -1.6}, {2 - 0.4 * i, 0.18, 2.2 - 0.3 * i});
  model.box({2.9, 0, 4.3}, {0.9, 0.9, 0.9}, 0.5);
  model.box({3.9, 0, 3.7}, {0.6, 0.35, 1.1}, -0.3);
  model.box({2.95, 0.9, 4.25}, {0.45, 0.45, 0.45}, 1.1);
  model.box({-1.3, 1.5, 3.6}, {1.6, 0.06, 0.8}, 0.35);
  model.box({-1.9, 0.7, 3.9}, {1.1, 0.06, 0.6}, -0.2);
  for (const double side : {-1.0, 1.0})
    model.post(Vec{-1.3, 0, 3.6} + turned({0.7 * side, 0, 0}, 0.35), 0.03, 1.5, 12);
  // Pedestals of the knot and of the ball.
  model.box({0.9, 0, 0.6}, {1.5, 0.35, 1.5}, 0.2);
  model.post({0.9, 0.35, 0.6}, 0.1, 0.75, 24);
  model.box({-3.1, 0, 1.9}, {0.9, 0.5, 0.9});
}

void add_knot(Model& model) {
  // A (2, 3) torus knot that stands upright; the hint points away from the torus' core circle.
  const Vec centre{0.9, 2.05, 0.6};
  const auto ring = [&](double angle, double radius) {
    return Vec{std::cos(angle) * radius, std::sin(angle) * radius, 0};
  };
  const auto point = [&](double t) {
    const double a = 4 * kPi * t, b = 6 * kPi * t;
    return centre + ring(a, 0.72 + 0.3 * std::cos(b)) + Vec{0, 0, 0.3 * std::sin(b)};
  };
  const auto hint = [&](Vec p) {
    const Vec q = p - centre;
    return q - unit({q.x, q.y, 0}) * 0.72;
  };
  model.tube(sample(420, true, point), 0.115, 20, true, hint);
}

void add_ball(Model& model) {
  // Rings of a lattice ball that rests on its pedestal.
  const double radius = 0.75, wire = 0.028;
  const Vec centre{-3.1, 0.5 + radius + wire, 1.9};
  const auto from_centre = [&](Vec p) { return p - centre; };
  for (int i = 0; i < 6; ++i) {
    const auto meridian = [&](double t) {
      return centre +
             turned({radius * std::cos(2 * kPi * t), radius * std::sin(2 * kPi * t), 0}, kPi * i / 6);
    };
    model.tube(sample(72, true, meridian), wire, 8, true, from_centre);
  }
  for (int i = -2; i <= 2; ++i) {
    const double height = radius * std::sin(kPi * i / 6), across = radius * std::cos(kPi * i / 6);
    const auto parallel = [&](double t) { return centre + turned({across, height, 0}, 2 * kPi * t); };
    model.tube(sample(72, true, parallel), wire, 8, true, from_centre);
  }
}

void add_stair(Model& solid, Model& thin) {
  // A spiral stair about a pole, its balusters and its handrail.
  const Vec foot{4.3, 0, -0.6};
  const int steps = 22;
  const double rise = 0.16, turn = 2 * kPi / 16;
  solid.post(foot, 0.09, steps * rise + 1, 24);
  for (int i = 0; i < steps; ++i) {
    const double angle = i * turn, height = (i + 1) * rise;
    solid.box(foot + turned({0.62, height - 0.05, 0}, angle), {1.1, 0.05, 0.36}, angle);
    thin.post(foot + turned({1.1, height, 0}, angle), 0.012, 0.9, 8);
  }
  const auto rail = [&](double t) {
    const double i = t * (steps - 1);
    return foot + turned({1.1, (i + 1) * rise + 0.9, 0}, i * turn);
  };
  thin.tube(sample(160, false, rail), 0.022, 10, false, [](Vec) { return Vec{0, 1, 0}; });
}

void add_fence_and_wires(Model& model) {
  for (int i = 0; i < 40; ++i) model.post({-5.9 + 0.16 * i, 0, 5.6}, 0.011, i % 5 == 0 ? 1.15 : 1.0, 8);
  for (const double height : {0.12, 0.92}) model.box({-2.78, height, 5.6}, {6.3, 0.03, 0.03});
  // Three wires sag from a mast to the wall.
  model.post({5.6, 0, 5.2}, 0.05, 4.2, 16);
  for (int i = 0; i < 3; ++i) {
    const Vec from{5.6, 4.1 - 0.25 * i, 5.2}, to{-5.9 + 1.1 * i, 2.5, -6.1};
    const auto wire = [&](double t) { return from + (to - from) * t - Vec{0, 2.4 * t * (1 - t), 0}; };
    model.tube(sample(60, false, wire), 0.009, 6, false, [](Vec) { return Vec{0, 1, 0}; });
  }
}

}  // namespace

int main(int argc, char** argv) {
  const std::string folder = argc > 1 ? std::string(argv[1]) + "/" : "";
  Model floor, solid, thin, knot;
  floor.box({0, -0.2, 0}, {13, 0.2, 12.6});
  add_arcade(solid);
  add_blocks(solid);
  add_stair(solid, thin);
  add_fence_and_wires(thin);
  add_ball(thin);
  add_knot(knot);
  const bool good = floor.write(folder + "courtyard_floor.obj") &&
                    solid.write(folder + "courtyard_solid.obj") &&
                    thin.write(folder + "courtyard_thin.obj") && knot.write(folder + "courtyard_knot.obj");
  if (!good) std::fputs("make_courtyard: a file cannot be written\n", stderr);
  return good ? 0 : 4;
}
