// SPDX-License-Identifier: Apache-2.0
// Writes a level of twelve rooms in three rows, open to the sky: walls, twelve balls in each room, and a
// crate that can be moved. Eleven rooms have a lamp; the twelfth light is the sun. The same bytes on every
// run.
//
//   make_level FOLDER [CRATE_X]     the crate's place in the sixth room, default 0; status 4 if a file can't
//   be written
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <string>
#include <vector>

namespace {

constexpr int kColumns = 4, kRows = 3;
constexpr double kRoom = 6, kHeight = 3, kWall = 0.2;

struct Vec {
  double x = 0, y = 0, z = 0;
};

/// An OBJ file in the making.
class Model {
 public:
  void box(Vec low, Vec high) {
    for (int n = 0; n < 8; ++n)
      vertex({(n & 1) != 0 ? high.x : low.x, (n & 2) != 0 ? high.y : low.y, (n & 4) != 0 ? high.z : low.z});
    constexpr std::array<std::array<int, 4>, 6> kSides{
        {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};
    for (const auto& side : kSides) {
      face(side[0], side[1], side[2]);
      face(side[0], side[2], side[3]);
    }
    first_ += 8;
  }

  void ball(Vec centre, double radius, int steps) {
    vertex({centre.x, centre.y + radius, centre.z});
    vertex({centre.x, centre.y - radius, centre.z});
    for (int up = 1; up < steps; ++up) {
      const double polar = std::numbers::pi * up / steps;
      for (int around = 0; around < 2 * steps; ++around) {
        const double angle = std::numbers::pi * around / steps;
        vertex({centre.x + radius * std::sin(polar) * std::cos(angle), centre.y + radius * std::cos(polar),
                centre.z + radius * std::sin(polar) * std::sin(angle)});
      }
    }
    const auto at = [steps](int up, int around) { return 2 + (up - 1) * 2 * steps + around % (2 * steps); };
    for (int around = 0; around < 2 * steps; ++around) {
      face(0, at(1, around + 1), at(1, around));
      face(1, at(steps - 1, around), at(steps - 1, around + 1));
      for (int up = 1; up + 1 < steps; ++up) {
        face(at(up, around), at(up, around + 1), at(up + 1, around));
        face(at(up, around + 1), at(up + 1, around + 1), at(up + 1, around));
      }
    }
    first_ += 2 + (steps - 1) * 2 * steps;
  }

  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  void vertex(Vec p) {
    std::array<char, 96> line;
    std::snprintf(line.data(), line.size(), "v %.6f %.6f %.6f\n", p.x, p.y, p.z);
    text_ += line.data();
  }
  void face(int a, int b, int c) {
    text_ += "f " + std::to_string(first_ + a) + " " + std::to_string(first_ + b) + " " +
             std::to_string(first_ + c) + "\n";
  }

  std::string text_;
  int first_ = 1;
};

void write(const std::string& path, const std::string& text) {
  std::FILE* file = std::fopen(path.c_str(), "wb");
  const bool written = file != nullptr && std::fwrite(text.data(), 1, text.size(), file) == text.size();
  if (file == nullptr || std::fclose(file) != 0 || !written) {
    std::fprintf(stderr, "%s: can't be written\n", path.c_str());
    std::exit(4);
  }
}

std::string walls() {
  Model model;
  const double width = kColumns * kRoom, depth = kRows * kRoom;
  model.box({-1, -0.2, -1}, {width + 1, 0, depth + 1});
  for (int n = 0; n <= kColumns; ++n)
    model.box({n * kRoom - kWall / 2, 0, 0}, {n * kRoom + kWall / 2, kHeight, depth});
  for (int n = 0; n <= kRows; ++n)
    model.box({0, 0, n * kRoom - kWall / 2}, {width, kHeight, n * kRoom + kWall / 2});
  return model.text();
}

Vec room_centre(int room) {
  return {(room % kColumns + 0.5) * kRoom, 0, (room / kColumns + 0.5) * kRoom};
}

std::string furniture(int room) {
  Model model;
  constexpr int kBalls = 12, kSteps = 16;
  for (int n = 0; n < kBalls; ++n) {
    const double angle = 2.4 * n + room, reach = 0.7 + 0.15 * n;
    const Vec centre = room_centre(room);
    model.ball({centre.x + reach * std::cos(angle), 0.3 + 0.1 * (n % 5), centre.z + reach * std::sin(angle)},
               0.15 + 0.02 * (n % 4), kSteps);
  }
  return model.text();
}

std::string number(double x) {
  std::array<char, 32> text;
  std::snprintf(text.data(), text.size(), "%.6g", x);
  return text.data();
}

std::string scene(const std::string& crate, bool with_sun) {
  std::string text = "{ \"geometry\": [ { \"file\": \"walls.obj\" }";
  for (int room = 0; room < kColumns * kRows; ++room)
    text += ",\n    { \"file\": \"room" + std::to_string(room) + ".obj\" }";
  const Vec place = room_centre(5);
  text += ",\n    { \"file\": \"crate.obj\", \"translate\": [" +
          number(place.x + std::strtod(crate.c_str(), nullptr)) + ", 0.5, " + number(place.z + 0.4) +
          "] } ],\n  \"lights\": [\n";
  for (int room = 0; room < kColumns * kRows; ++room) {
    const Vec centre = room_centre(room);
    text += (room == 0 ? "" : ",\n") + ("    { \"name\": \"lamp" + std::to_string(room)) +
            "\", \"type\": \"disk\", \"position\": [" + number(centre.x) + ", 2.9, " + number(centre.z) +
            "], \"direction\": [0, -1, 0], \"radius\": 0.2, \"fov\": 90 }";
  }
  if (with_sun)
    text +=
        ",\n    { \"name\": \"sun\", \"type\": \"distant\", \"direction\": [1, -3, 0.5], \"angle\": 0.53 }";
  return text + " ] }\n";
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2 || argc > 4 || (argc == 4 && argv[3] != std::string("sun"))) {
    std::fprintf(stderr, "usage: make_level FOLDER [CRATE_X [sun]]\n");
    return 2;
  }
  const std::string folder = std::string(argv[1]) + "/";
  write(folder + "walls.obj", walls());
  for (int room = 0; room < kColumns * kRows; ++room)
    write(folder + "room" + std::to_string(room) + ".obj", furniture(room));
  Model crate;
  crate.box({-0.3, -0.3, -0.3}, {0.3, 0.3, 0.3});
  write(folder + "crate.obj", crate.text());
  write(folder + "level.scene.json", scene(argc > 2 ? argv[2] : "0", argc == 4));
  return 0;
}
