#include "apps/formats/other_formats.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <string_view>

#include "apps/frontend/line/small_letters.h"
#include "apps/frontend/line/words.h"
#include "core/base/expect.h"
#include "core/base/ranges.h"

namespace dmpc::apps {
namespace {

namespace fs = std::filesystem;

/// A program that makes another file of one.
struct Converter {
  std::string_view program, package;  ///< Debian's
  std::string_view made_ending;
  std::string_view line;  ///< in which IN and OUT stand for names of files, and IMPORT for what Blender's Python calls that
};

constexpr Converter assimp{.program = "Assimp", .package = "assimp-utils", .made_ending = "glb", .line = "assimp export IN OUT"};
constexpr Converter gmsh{.program = "Gmsh", .package = "gmsh", .made_ending = "stl", .line = "gmsh IN -2 -o OUT"};
constexpr Converter blender{
    .program = "Blender",
    .package = "blender",
    .made_ending = "glb",
    .line =
        "blender --background --factory-startup --python-expr \"import bpy, sys; "
        "bpy.ops.wm.read_factory_settings(use_empty=True); bpy.ops.IMPORT(filepath=sys.argv[-2]); "
        "bpy.ops.export_scene.gltf(filepath=sys.argv[-1], export_cameras=True, export_lights=True)\" -- IN OUT"};
constexpr Converter blender_itself{
    .program = "Blender",
    .package = "blender",
    .made_ending = "glb",
    .line =
        "blender --background --factory-startup IN --python-expr \"import bpy, sys; "
        "bpy.ops.export_scene.gltf(filepath=sys.argv[-1], export_cameras=True, export_lights=True)\" -- OUT"};

struct OtherFormat {
  std::string_view ending, name;
  Converter converter;
  std::string_view import = "";
};

constexpr std::array other_formats{
    OtherFormat{"3ds", "3DS", assimp},
    OtherFormat{"3mf", "3MF", assimp},
    OtherFormat{"abc", "Alembic", blender, "wm.alembic_import"},
    OtherFormat{"ac", "AC3D", assimp},
    OtherFormat{"amf", "AMF", assimp},
    OtherFormat{"ase", "ASE", assimp},
    OtherFormat{"blend", "Blender's own", blender_itself},
    OtherFormat{"dae", "Collada", blender, "wm.collada_import"},
    OtherFormat{"dxf", "DXF", assimp},
    OtherFormat{"fbx", "FBX", blender, "import_scene.fbx"},
    OtherFormat{"iges", "IGES", gmsh},
    OtherFormat{"igs", "IGES", gmsh},
    OtherFormat{"lwo", "LWO", assimp},
    OtherFormat{"ms3d", "MS3D", assimp},
    OtherFormat{"step", "STEP", gmsh},
    OtherFormat{"stp", "STEP", gmsh},
    OtherFormat{"usd", "USD", blender, "wm.usd_import"},
    OtherFormat{"usda", "USD", blender, "wm.usd_import"},
    OtherFormat{"usdc", "USD", blender, "wm.usd_import"},
    OtherFormat{"usdz", "USD", blender, "wm.usd_import"},
    OtherFormat{"x", "DirectX", assimp},
    OtherFormat{"x3d", "X3D", assimp},
};

const OtherFormat* format_of_path(const std::string& path) {
  return core::find_in(other_formats, ending_of(path), &OtherFormat::ending);
}

void put_in(std::string& text, std::string_view what, const std::string& with) {
  text.replace(text.find(what), what.size(), with);
}

}  // namespace

bool is_other_format(const std::string& path) { return format_of_path(path) != nullptr; }

std::string how_to_convert(const std::string& path) {
  const OtherFormat* const format = format_of_path(path);
  core::expect(format != nullptr, "what is of no other format needs no converter");
  const Converter& by = format->converter;
  const std::string made = fs::path(path).replace_extension(by.made_ending).string();
  std::string line(by.line);  // from its end on, as names of files may have anything in them
  put_in(line, "OUT", in_quotes(made));
  put_in(line, "IN ", in_quotes(path) + " ");
  if (!format->import.empty()) {
    put_in(line, "IMPORT", std::string(format->import));
  }
  return std::string(format->name) + " is not read: have " + std::string(by.program) + " (Debian's " + std::string(by.package) +
         ") make " + std::string(by.made_ending == "glb" ? "glTF" : "STL") + " of it, and look at the result:\n  " + line;
}

}  // namespace dmpc::apps
