#include "apps/formats/other_formats.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <string_view>

#include "core/base/expect.h"

namespace dmpc::apps {
namespace {

namespace fs = std::filesystem;

/// A program that makes another file of one.
struct Converter {
  std::string_view program, package;  ///< Debian's
  std::string_view made_ending;
  std::string_view line;  ///< in which IN and OUT stand for names of files
};

constexpr Converter assimp{.program = "Assimp", .package = "assimp-utils", .made_ending = "glb", .line = "assimp export IN OUT"};
constexpr Converter gmsh{.program = "Gmsh", .package = "gmsh", .made_ending = "stl", .line = "gmsh IN -2 -o OUT"};
constexpr Converter blender_itself{.program = "Blender",
                                   .package = "blender",
                                   .made_ending = "glb",
                                   .line =
                                       "blender --background IN --python-expr \"import bpy, sys; "
                                       "bpy.ops.export_scene.gltf(filepath=sys.argv[-1])\" -- OUT"};

/// By what Blender's Python calls the import of a format.
#define DMPC_BLENDER(import)                                                                                       \
  Converter {                                                                                                      \
    .program = "Blender", .package = "blender", .made_ending = "glb",                                              \
    .line =                                                                                                        \
        "blender --background --python-expr \"import bpy, sys; bpy.ops.wm.read_factory_settings(use_empty=True); " \
        "bpy.ops." import "(filepath=sys.argv[-2]); bpy.ops.export_scene.gltf(filepath=sys.argv[-1])\" -- IN OUT"  \
  }

struct OtherFormat {
  std::string_view ending, name;
  Converter converter;
};

constexpr std::array formats{
    OtherFormat{"3ds", "3DS", assimp},
    OtherFormat{"3mf", "3MF", assimp},
    OtherFormat{"abc", "Alembic", DMPC_BLENDER("wm.alembic_import")},
    OtherFormat{"ac", "AC3D", assimp},
    OtherFormat{"amf", "AMF", assimp},
    OtherFormat{"ase", "ASE", assimp},
    OtherFormat{"blend", "Blender's own", blender_itself},
    OtherFormat{"dae", "Collada", DMPC_BLENDER("wm.collada_import")},
    OtherFormat{"dxf", "DXF", assimp},
    OtherFormat{"fbx", "FBX", DMPC_BLENDER("import_scene.fbx")},
    OtherFormat{"iges", "IGES", gmsh},
    OtherFormat{"igs", "IGES", gmsh},
    OtherFormat{"lwo", "LWO", assimp},
    OtherFormat{"ms3d", "MS3D", assimp},
    OtherFormat{"step", "STEP", gmsh},
    OtherFormat{"stp", "STEP", gmsh},
    OtherFormat{"usd", "USD", DMPC_BLENDER("wm.usd_import")},
    OtherFormat{"usda", "USD", DMPC_BLENDER("wm.usd_import")},
    OtherFormat{"usdc", "USD", DMPC_BLENDER("wm.usd_import")},
    OtherFormat{"usdz", "USD", DMPC_BLENDER("wm.usd_import")},
    OtherFormat{"x", "DirectX", assimp},
    OtherFormat{"x3d", "X3D", assimp},
};

#undef DMPC_BLENDER

const OtherFormat* find(const std::string& path) {
  std::string ending = fs::path(path).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return std::tolower(c); });
  const auto* const found = std::find_if(formats.begin(), formats.end(),
                                         [&](const OtherFormat& format) { return ending == "." + std::string(format.ending); });
  return found == formats.end() ? nullptr : found;
}

/// As a shell takes it.
std::string quoted(const std::string& word) {
  std::string text = "'";
  for (const char letter : word) {
    text += letter == '\'' ? "'\\''" : std::string(1, letter);
  }
  return text + "'";
}

void replace(std::string& text, std::string_view what, const std::string& with) {
  text.replace(text.find(what), what.size(), with);
}

}  // namespace

bool is_other_format(const std::string& path) { return find(path) != nullptr; }

std::string how_to_convert(const std::string& path) {
  const OtherFormat* const format = find(path);
  core::expect(format != nullptr, "what is of no other format needs no converter");
  const Converter& by = format->converter;
  const std::string made = fs::path(path).replace_extension(by.made_ending).string();
  std::string line(by.line);
  replace(line, "OUT", quoted(made));
  replace(line, "IN", quoted(path));
  return std::string(format->name) + " is not read: have " + std::string(by.program) + " (Debian's " + std::string(by.package) +
         ") make " + std::string(by.made_ending == "glb" ? "glTF" : "STL") + " of it, and look at the result:\n  " + line;
}

}  // namespace dmpc::apps
