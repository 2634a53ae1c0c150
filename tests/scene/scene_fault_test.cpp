// SPDX-License-Identifier: Apache-2.0
// Every way in which a scene file can be wrong, and the one line that tells.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <ostream>

#include "scene_folder.h"

namespace pdsm::test {
namespace {

struct Fault {
  std::string scene;
  std::string message;  ///< what it is refused with begins so

  friend void PrintTo(const Fault& fault, std::ostream* to) { *to << fault.scene; }
};

class SceneFault : public testing::TestWithParam<Fault> {};

TEST_P(SceneFault, IsToldInOneLine) {
  const SceneFolder folder;
  folder.write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const std::string told = folder.fault_of(GetParam().scene);
  EXPECT_EQ(told.substr(0, GetParam().message.size()), GetParam().message);
}

Fault in_light(const std::string& fields, const std::string& message) {
  return {scene_with_light(fields), "level.scene.json:lights[0]." + message};
}

/// A distant light from straight above with further fields.
Fault in_sun(const std::string& fields, const std::string& message) {
  return {R"({"lights": [{"type": "distant", "direction": [0, -1, 0], )" + fields + "}]}",
          "level.scene.json:lights[0]." + message};
}

Fault in_geometry(const std::string& fields, const std::string& message) {
  return {scene_of("a.obj", fields), "level.scene.json:geometry[0]." + message};
}

INSTANTIATE_TEST_SUITE_P(
    Json, SceneFault,
    testing::Values(
        Fault{"", "level.scene.json:1: syntax error while parsing value - unexpected end of input"},
        Fault{"{\n\"geometry\": [,]\n}",
              "level.scene.json:2: syntax error while parsing value - unexpected ','"},
        Fault{"{\r\n\r\n\"lights\": [}\r\n", "level.scene.json:3: syntax error"},
        Fault{"{\n\n  \"lights\": []\n", "level.scene.json:3: syntax error"},
        Fault{"{\n\"a\n\": 1}", "level.scene.json:2: syntax error while parsing object key - invalid string"},
        Fault{"{\"lights\": []}\n\nx",
              "level.scene.json:3: syntax error while parsing value - invalid literal"},
        Fault{"{\n// said\n/* and\n said */\n\"lights\": [NaN]}", "level.scene.json:5: syntax error"},
        Fault{"{\"lights\":\n [{\"width\": 1e999}]}", "level.scene.json:2: number overflow parsing '1e999'"},
        Fault{"{\"lights\": [\"\xff\"]}",
              "level.scene.json:1: syntax error while parsing value - invalid string"},
        Fault{"[]", "level.scene.json: must be an object"}, Fault{"3", "level.scene.json: must be an object"},
        Fault{R"({"lights": [], "lights": []})", "level.scene.json:lights: is given twice"},
        Fault{R"({"geometry": [{"file": "a.obj"}, {"file": "a.obj", "casts": true, "casts": true}]})",
              "level.scene.json:geometry[1].casts: is given twice"},
        Fault{R"({"light": []})",
              "level.scene.json:light: unknown key; known are geometry, volumes, curves, lights"},
        Fault{"{\"a\\nb\": []}", "level.scene.json:a b: unknown key"},
        Fault{R"({"lights": {}})", "level.scene.json:lights: must be an array"},
        Fault{R"({"geometry": 1})", "level.scene.json:geometry: must be an array"},
        Fault{R"({"volumes": {}})", "level.scene.json:volumes: must be an array"},
        Fault{R"({"volumes": [{"file": "smoke.vdb"}]})",
              "level.scene.json:volumes[0].file: smoke.vdb: no such file"},
        Fault{R"({"lights": [7]})", "level.scene.json:lights[0]: must be an object"},
        Fault{R"({"geometry": ["a.obj"]})", "level.scene.json:geometry[0]: must be an object"}));

INSTANTIATE_TEST_SUITE_P(
    Geometry, SceneFault,
    testing::Values(
        Fault{R"({"geometry": [{}]})", "level.scene.json:geometry[0].file: is missing"},
        Fault{R"({"geometry": [{"file": 1}]})", "level.scene.json:geometry[0].file: must be a string"},
        Fault{R"({"geometry": [{"file": ""}]})", "level.scene.json:geometry[0].file: must name a file"},
        Fault{R"({"geometry": [{"file": "a.obj\u0000"}]})",
              "level.scene.json:geometry[0].file: must name a file"},
        in_geometry(R"("scales": 1)", "scales: unknown key; known are file, scale"),
        in_geometry(R"("scale": 0)", "scale: must be a number or [x,y,z], not 0"),
        in_geometry(R"("scale": [1, 0, 1])", "scale: must be a number or [x,y,z], not 0"),
        in_geometry(R"("scale": "big")", "scale: must be a number or [x,y,z], not 0"),
        in_geometry(R"("scale": [1, 2])", "scale: must be [x,y,z], three numbers"),
        in_geometry(R"("scale": 1e308)", "scale: must not exceed 1e+12 in size"),
        in_geometry(R"("rotate": 90)", "rotate: must be [x,y,z], three numbers"),
        in_geometry(R"("rotate": [0, "90", 0])", "rotate: must be [x,y,z], three numbers"),
        in_geometry(R"("translate": [1e308, 0, 0])", "translate: must not exceed 1e+12 in size"),
        in_geometry(R"("translate": null)", "translate: must be [x,y,z], three numbers"),
        in_geometry(R"("casts": 1)", "casts: must be true or false"),
        in_geometry(R"("receives": "yes")", "receives: must be true or false"),
        in_geometry(R"("opacity": "half")", "opacity: must be a number"),
        in_geometry(R"("opacity": 1.5)", "opacity: must be a number from 0 to 1"),
        in_geometry(R"("opacity": -1)", "opacity: must be a number from 0 to 1")));

INSTANTIATE_TEST_SUITE_P(
    LightShape, SceneFault,
    testing::Values(
        Fault{R"({"lights": [{"position": [0,0,0]}]})", "level.scene.json:lights[0].type: is missing"},
        Fault{R"({"lights": [{"type": "disk", "radius": 1, "direction": [0,0,1]}]})",
              "level.scene.json:lights[0].position: is missing"},
        Fault{R"({"lights": [{"type": "disk", "radius": 1, "position": [0,0,1]}]})",
              "level.scene.json:lights[0].direction: is missing"},
        in_light(R"("type": "spot")", "type: must be rect, disk, sphere, mesh or distant"),
        in_light(R"("type": "sphere", "radius": 0.3, "fov": 60)", "fov: unknown key"),
        in_light(R"("type": "sphere", "radius": -0.3)", "radius: must be a number >= 0"),
        in_light(R"("type": "sphere", "radius": 0.3, "faces": 5)",
                 "faces: must be 6 for sphere and mesh lights"),
        in_light(R"("two_sided": 1)", "two_sided: must be true or false"),
        in_light(R"("two_sided": true, "faces": 5)", "faces: must be 1 or 6 for two-sided lights"),
        in_light(R"("type": "sphere", "radius": 0.3, "two_sided": true)", "two_sided: unknown key"),
        in_light(R"("faces": 5, "fov": 60)", "fov: must not be given together with several faces"),
        in_light(R"("faces": 5, "window": [-1, -1, 1, 1])",
                 "window: must not be given together with several faces"),
        in_light(R"("type": "distant", "angle": 0.53)",
                 "position: unknown key; known are name, type, direction"),
        in_sun(R"("angle": -0.1)", "angle: must be a number from 0 to 90"),
        in_sun(R"("angle": 90.5)", "angle: must be a number from 0 to 90"),
        in_sun(R"("angle": "wide")", "angle: must be a number"), in_sun(R"("fov": 30)", "fov: unknown key"),
        in_sun(R"("width": 3)", "width: unknown key"), in_sun(R"("height": 3)", "height: unknown key"),
        in_sun(R"("radius": 1)", "radius: unknown key"), in_sun(R"("faces": 1)", "faces: unknown key"),
        in_sun(R"("emission": "sky.exr")", "emission: unknown key"),
        in_sun(R"("near": 0)", "near: must be a number > 0"),
        in_sun(R"("near": 3, "far": 2)", "near: must be less than far"),
        in_sun(R"("window": [1, 0, 0, 1])", "window: must be [x0,y0,x1,y1]"),
        in_sun(R"("up": [0, 1, 0])", "up: must not be zero or parallel to direction"),
        Fault{R"({"lights": [{"type": "distant", "angle": 1}]})",
              "level.scene.json:lights[0].direction: is missing"},
        in_light(R"("type": "mesh", "file": "tube.obj")", "position: unknown key"),
        Fault{R"({"lights": [{"type": "mesh", "file": "tube.obj", "faces": 5}]})",
              "level.scene.json:lights[0].faces: must be 6 for sphere and mesh lights"},
        Fault{R"({"lights": [{"type": "mesh"}]})", "level.scene.json:lights[0].file: is missing"},
        in_light(R"("type": "rect", "width": 1)", "height: is missing"),
        in_light(R"("type": "rect", "height": 1)", "width: is missing"),
        in_light(R"("type": "rect", "width": -1, "height": 1)", "width: must be a number >= 0"),
        in_light(R"("type": "rect", "width": "1", "height": 1)", "width: must be a number >= 0"),
        in_light(R"("type": "rect", "width": 1e13, "height": 1)", "width: must not exceed 1e+12 in size"),
        in_light(R"("type": "rect", "width": 1, "height": 1, "radius": 1)", "radius: unknown key"),
        in_light(R"("radius": -0.5)", "radius: must be a number >= 0"),
        in_light(R"("width": 1)", "width: unknown key"),
        in_light(R"("colour": [1, 1, 1])", "colour: unknown key; known are name, type"),
        in_light(R"("faces": 6)", "faces: must be 1 or 5"),
        in_light(R"("faces": 2)", "faces: must be 1 or 5")));

INSTANTIATE_TEST_SUITE_P(
    LightFields, SceneFault,
    testing::Values(in_light(R"("name": "")", "name: must be letters, digits, _ and -"),
                    in_light(R"("name": "../key")", "name: must be letters, digits, _ and -"),
                    in_light(R"("name": "schlüssel")", "name: must be letters, digits, _ and -"),
                    in_light(R"("name": 1)", "name: must be a string"),
                    in_light(R"("direction": [0, 0, 0])", "direction: must not be zero"),
                    in_light(R"("direction": [0, 1])", "direction: must be [x,y,z], three numbers"),
                    in_light(R"("up": [0, 2, 0])", "up: must not be zero or parallel to direction"),
                    in_light(R"("up": [0, 0, 0])", "up: must not be zero or parallel to direction"),
                    in_light(R"("position": [0, 1e300, 0])", "position: must not exceed 1e+12 in size"),
                    in_light(R"("fov": 0)", "fov: must be a number > 0 and <= 120"),
                    in_light(R"("fov": 120.5)", "fov: must be a number > 0 and <= 120"),
                    in_light(R"("fov": true)", "fov: must be a number"),
                    in_light(R"("fov": 30, "window": [-1, -1, 1, 1])",
                             "fov: must not be given together with window"),
                    in_light(R"("window": [-1, -1, 1])", "window: must be [x0,y0,x1,y1]"),
                    in_light(R"("window": [1, -1, -1, 1])", "window: must be [x0,y0,x1,y1]"),
                    in_light(R"("window": [-1, 1, 1, 1])", "window: must be [x0,y0,x1,y1]"),
                    in_light(R"("window": 1)", "window: must be an array"),
                    in_light(R"("near": 0)", "near: must be a number > 0"),
                    in_light(R"("far": -3)", "far: must be a number > 0"),
                    in_light(R"("near": 3, "far": 3)", "near: must be less than far"),
                    in_light(R"("resolution": 0)", "resolution: must be an integer from 1 to 16384"),
                    in_light(R"("resolution": 1e12)", "resolution: must be an integer from 1 to 16384"),
                    in_light(R"("resolution": 12.5)", "resolution: must be an integer from 1 to 16384"),
                    in_light(R"("resolution": [12])", "resolution: must be R or [w,h]"),
                    in_light(R"("resolution": [12, 0])", "resolution: must be R or [w,h]"),
                    in_light(R"("samples": 0)", "samples: must be an integer from 1 to 65536"),
                    in_light(R"("samples": -1)", "samples: must be an integer from 1 to 65536"),
                    in_light(R"("samples": 65537)", "samples: must be an integer from 1 to 65536"),
                    in_light(R"("samples": "256")", "samples: must be an integer from 1 to 65536")));

std::string two_lights(const std::string& first, const std::string& second) {
  const std::string rest = R"("type": "disk", "radius": 1, "position": [0,1,0], "direction": [0,-1,0]})";
  return "{\"lights\": [{" + first + rest + ", {" + second + rest + "]}";
}

TEST(SceneFaults, NamesAreUnique) {
  const SceneFolder folder;
  EXPECT_EQ(folder.fault_of(two_lights(R"("name": "key", )", R"("name": "key", )")),
            "level.scene.json:lights[1].name: \"key\" is the name of lights[0] too");
  // A name that another light has by its place is taken as well.
  EXPECT_EQ(folder.fault_of(two_lights(R"("name": "light2", )", "")),
            "level.scene.json:lights[1].name: \"light2\" is the name of lights[0] too");
  EXPECT_EQ(folder.fault_of(two_lights("", "")), "");
}

/// Faults of files: as the scene, as its geometry, and as what geometry refers to.
class FileFault : public testing::Test {
 protected:
  SceneFolder folder_;
};

TEST_F(FileFault, MissingFile) {
  EXPECT_EQ(folder_.scene_fault_of("no.scene.json"), "no.scene.json: no such file");
  EXPECT_EQ(folder_.fault_of(scene_of("no.obj")), "level.scene.json:geometry[0].file: no.obj: no such file");
  EXPECT_EQ(folder_.import_fault_of("no.glb"), "no.glb: no such file");
}

TEST_F(FileFault, DirectoryForAFile) {
  std::filesystem::create_directory(folder_.path() / "folder.obj");
  EXPECT_EQ(folder_.scene_fault_of("folder.obj"), "folder.obj: is a directory, not a file");
  EXPECT_EQ(folder_.fault_of(scene_of("folder.obj")),
            "level.scene.json:geometry[0].file: folder.obj: is a directory, not a file");
}

TEST_F(FileFault, FifoForAFile) {
  for (const char* name : {"pipe.obj", "pipe.gltf", "pipe.ply.gz"}) {
    ASSERT_EQ(mkfifo((folder_.path() / name).c_str(), 0600), 0);
    EXPECT_EQ(folder_.import_fault_of(name), std::string(name) + ": is not a regular file");
  }
}

TEST_F(FileFault, FifoForTheScene) {
  ASSERT_EQ(mkfifo((folder_.path() / "pipe.scene.json").c_str(), 0600), 0);
  EXPECT_EQ(folder_.scene_fault_of("pipe.scene.json"), "pipe.scene.json: is not a regular file");
}

TEST_F(FileFault, FifoForAReferredFile) {
  ASSERT_EQ(mkfifo((folder_.path() / "pipe.mtl").c_str(), 0600), 0);
  ASSERT_EQ(mkfifo((folder_.path() / "pipe.bin").c_str(), 0600), 0);
  folder_.write("a.obj", "mtllib pipe.mtl\nusemtl red\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  EXPECT_EQ(folder_.import_fault_of("a.obj"), "");
  folder_.write("a.gltf",
                R"({"asset": {"version": "2.0"}, "buffers": [{"uri": "pipe.bin", "byteLength": 4}]})");
  EXPECT_NE(folder_.import_fault_of("a.gltf").find("pipe.bin"), std::string::npos);
}

TEST_F(FileFault, GltfAsTheScene) {
  EXPECT_EQ(folder_.scene_fault_of("no.glb"), "no.glb: no such file");
  folder_.write("level.glb", "glTF");
  EXPECT_EQ(folder_.scene_fault_of("level.glb").find("level.glb: "), 0U);
}

TEST_F(FileFault, GeometryOfNoKnownKind) {
  folder_.write("a.txt", "hello");
  EXPECT_EQ(folder_.import_fault_of("a.txt").substr(0, 29), "a.txt: No suitable reader fou");
}

}  // namespace
}  // namespace pdsm::test
