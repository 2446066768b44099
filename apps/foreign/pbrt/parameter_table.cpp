#include "apps/foreign/pbrt/parameter_table.h"

#include <algorithm>
#include <array>

namespace dmpc::apps::pbrt {
namespace {

constexpr std::string_view film =
    "integer xresolution, integer yresolution, float iso, float whitebalance, string sensor, "
    "integer pixelbounds, float cropwindow";
constexpr std::string_view film_file = "string filename, bool savefp16, float diagonal";
constexpr std::string_view shutter = "float shutteropen, float shutterclose";
constexpr std::string_view lens = "float lensradius, float focaldistance, float frameaspectratio, float screenwindow";
constexpr std::string_view sampler = "integer pixelsamples", sampling = "integer seed, string randomization";
constexpr std::string_view radii = "float xradius, float yradius";
constexpr std::string_view depth = "integer maxdepth";
constexpr std::string_view bumps = "texture displacement, string normalmap";
constexpr std::string_view rough =
    "float roughness, float uroughness, float vroughness, bool remaproughness, float eta, "
    "rgb reflectance, texture displacement, string normalmap";
constexpr std::string_view layers = "float thickness, float g, integer maxdepth, integer nsamples";
constexpr std::string_view plane = "vector3 v1, vector3 v2";

constexpr std::array table{
    ParameterRow{"Film", "rgb", film, "float maxcomponentvalue", film_file},
    ParameterRow{"Film", "gbuffer", film, "float maxcomponentvalue",
                 "string filename, bool savefp16, float diagonal, string coordinatesystem"},
    ParameterRow{"Film", "spectral", film, "float maxcomponentvalue, integer nbuckets, float lambdamin, float lambdamax",
                 film_file},
    ParameterRow{"Camera", "perspective",
                 "float shutteropen, float shutterclose, float fov, float lensradius, float frameaspectratio, float screenwindow",
                 "", "float focaldistance"},
    ParameterRow{"Camera", "orthographic", shutter, "", lens},
    ParameterRow{"Camera", "realistic", shutter, "",
                 "string lensfile, float aperturediameter, float focusdistance, string aperture"},
    ParameterRow{"Camera", "spherical", shutter, "",
                 "float lensradius, float focaldistance, float frameaspectratio, float screenwindow, string mapping"},
    ParameterRow{"Sampler", "halton", sampler, "", sampling},
    ParameterRow{"Sampler", "zsobol", sampler, "", sampling},
    ParameterRow{"Sampler", "paddedsobol", sampler, "", sampling},
    ParameterRow{"Sampler", "sobol", sampler, "", sampling},
    ParameterRow{"Sampler", "pmj02bn", sampler, "", "integer seed"},
    ParameterRow{"Sampler", "independent", sampler, "", "integer seed"},
    ParameterRow{"Sampler", "stratified", "integer xsamples, integer ysamples", "", "integer seed, bool jitter"},
    ParameterRow{"PixelFilter", "box", "", "", radii},
    ParameterRow{"PixelFilter", "triangle", "", "", radii},
    ParameterRow{"PixelFilter", "gaussian", "", "", "float xradius, float yradius, float sigma"},
    ParameterRow{"PixelFilter", "mitchell", "", "", "float xradius, float yradius, float B, float C"},
    ParameterRow{"PixelFilter", "sinc", "", "", "float xradius, float yradius, float tau"},
    ParameterRow{"Integrator", "path", depth, "bool regularize", "string lightsampler"},
    ParameterRow{"Integrator", "volpath", depth, "bool regularize", "string lightsampler"},
    ParameterRow{"Integrator", "simplepath", depth, "", "bool samplelights, bool samplebsdf"},
    ParameterRow{"Integrator", "simplevolpath", depth, "", ""},
    ParameterRow{"Integrator", "lightpath", depth, "", ""},
    ParameterRow{"Integrator", "randomwalk", depth, "", ""},
    ParameterRow{"Integrator", "bdpt", depth, "bool regularize, bool visualizestrategies, bool visualizeweights", ""},
    ParameterRow{"Integrator", "mlt", depth, "bool regularize",
                 "integer bootstrapsamples, integer chains, integer mutationsperpixel, float largestepprobability, float sigma"},
    ParameterRow{"Integrator", "sppm", depth, "", "integer photonsperiteration, float radius, integer seed"},
    ParameterRow{"Integrator", "ambientocclusion", "", "float maxdistance", "bool cossample"},
    ParameterRow{"Integrator", "function", "", "string function, string filename, string imagefilename", "bool skipbad"},
    ParameterRow{"Accelerator", "bvh", "", "", "string splitmethod, integer maxnodeprims"},
    ParameterRow{"Accelerator", "kdtree", "", "",
                 "integer intersectcost, integer traversalcost, float emptybonus, integer maxprims, integer maxdepth"},
    ParameterRow{"LightSource", "point", "rgb I, float scale, float power, point3 from", "", ""},
    ParameterRow{"LightSource", "spot",
                 "rgb I, float scale, float power, point3 from, point3 to, float coneangle, float conedeltaangle", "", ""},
    ParameterRow{"LightSource", "goniometric", "rgb I, float scale, float power, string filename", "", ""},
    ParameterRow{"LightSource", "projection", "float scale, float power, float fov, string filename", "", ""},
    ParameterRow{"LightSource", "distant", "rgb L, float scale, point3 from, point3 to, float illuminance", "", ""},
    ParameterRow{"LightSource", "infinite", "rgb L, float scale, string filename, float illuminance, point3 portal", "", ""},
    ParameterRow{"AreaLightSource", "diffuse", "rgb L, float scale, bool twosided, string filename, float power", "", ""},
    ParameterRow{"Shape", "sphere", "float radius, float zmin, float zmax, float phimax, float alpha", "", ""},
    ParameterRow{"Shape", "cylinder", "float radius, float zmin, float zmax, float phimax, float alpha", "", ""},
    ParameterRow{"Shape", "disk", "float radius, float height, float innerradius, float phimax, float alpha", "", ""},
    ParameterRow{"Shape", "trianglemesh", "integer indices, point3 P, point2 uv, normal N, float alpha", "",
                 "vector3 S, integer faceIndices"},
    ParameterRow{"Shape", "bilinearmesh", "integer indices, point3 P, point2 uv, normal N, float alpha",
                 "string emissionfilename", "integer faceIndices"},
    ParameterRow{"Shape", "plymesh", "string filename, texture displacement, float alpha", "", "float edgelength"},
    ParameterRow{"Shape", "loopsubdiv", "integer levels, integer indices, point3 P, float alpha", "", "string scheme"},
    ParameterRow{"Material", "diffuse", "rgb reflectance, texture displacement, string normalmap", "", ""},
    ParameterRow{"Material", "coateddiffuse", rough, "rgb albedo", layers},
    ParameterRow{"Material", "conductor",
                 "rgb eta, rgb k, rgb reflectance, float roughness, float uroughness, float vroughness, bool remaproughness, "
                 "texture displacement, string normalmap",
                 "", ""},
    ParameterRow{"Material", "coatedconductor",
                 "float interface.eta, rgb conductor.eta, rgb conductor.k, rgb reflectance, float conductor.roughness, "
                 "float conductor.uroughness, float conductor.vroughness, bool remaproughness, texture displacement, "
                 "string normalmap",
                 "rgb albedo, float interface.roughness, float interface.uroughness, float interface.vroughness", layers},
    ParameterRow{"Material", "dielectric",
                 "float eta, float roughness, float uroughness, float vroughness, bool remaproughness, texture displacement, "
                 "string normalmap",
                 "", ""},
    ParameterRow{"Material", "thindielectric", "float eta, texture displacement, string normalmap", "", ""},
    ParameterRow{"Material", "diffusetransmission",
                 "rgb reflectance, rgb transmittance, float scale, texture displacement, string normalmap", "", ""},
    ParameterRow{"Material", "subsurface", "rgb reflectance, texture displacement, string normalmap", "",
                 "string name, rgb sigma_a, rgb sigma_s, rgb mfp, float g, float scale, float eta, float roughness, "
                 "float uroughness, float vroughness, bool remaproughness"},
    ParameterRow{"Material", "hair", "rgb reflectance, rgb color", "",
                 "rgb sigma_a, float eumelanin, float pheomelanin, float eta, float beta_m, float beta_n, float alpha"},
    ParameterRow{"Material", "measured", bumps, "", "string filename"},
    ParameterRow{"Material", "mix", "string materials, float amount", "", ""},
    ParameterRow{"Texture", "constant", "rgb value", "", ""},
    ParameterRow{"Texture", "scale", "rgb tex, float scale", "", ""},
    ParameterRow{"Texture", "mix", "rgb tex1, rgb tex2, float amount", "", ""},
    ParameterRow{"Texture", "directionmix", "rgb tex1, rgb tex2", "", "vector3 dir"},
    ParameterRow{"Texture", "imagemap",
                 "string mapping, float uscale, float vscale, float udelta, float vdelta, string filename, string wrap, "
                 "float scale, bool invert, string encoding",
                 "", "vector3 v1, vector3 v2, string filter, float maxanisotropy"},
    ParameterRow{"Texture", "checkerboard",
                 "string mapping, float uscale, float vscale, float udelta, float vdelta, integer dimension, rgb tex1, rgb tex2",
                 "", plane},
    ParameterRow{"Texture", "dots", "rgb inside, rgb outside", "",
                 "string mapping, float uscale, float vscale, float udelta, float vdelta, vector3 v1, vector3 v2"},
    ParameterRow{"Texture", "bilerp", "", "",
                 "rgb v00, rgb v01, rgb v10, rgb v11, string mapping, float uscale, float vscale, float udelta, float vdelta, "
                 "vector3 v1, vector3 v2"},
    ParameterRow{"Texture", "fbm", "", "", "integer octaves, float roughness"},
    ParameterRow{"Texture", "wrinkled", "", "", "integer octaves, float roughness"},
    ParameterRow{"Texture", "windy", "", "", ""},
    ParameterRow{"Texture", "marble", "", "", "integer octaves, float roughness, float scale, float variation"},
    ParameterRow{"Texture", "ptex", "", "", "string filename, string encoding, float scale"},
    ParameterRow{
        "Option", "", "", "bool forcediffuse",
        "bool disablepixeljitter, bool disabletexturefiltering, bool disablewavelengthjitter, float displacementedgescale, "
        "string msereferenceimage, string msereferenceout, string rendercoordsys, integer seed, bool pixelstats, "
        "bool wavefront"},
};

/// Returns the position of the letter, or the text's length without it.
std::size_t place_of(char letter, std::string_view text) {
  std::size_t at = 0;
  while (at < text.size() && text[at] != letter) {
    ++at;
  }
  return at;
}

/// Returns nullptr if there is no such row.
const ParameterRow* find_row(std::string_view statement, std::string_view kind) {
  const auto* const row = std::find_if(table.begin(), table.end(),
                                       [&](const ParameterRow& one) { return one.statement == statement && one.kind == kind; });
  return row == table.end() ? nullptr : row;
}

bool has(std::string_view list, std::string_view name) {
  while (!list.empty()) {
    if (next_of(list).name == name) {
      return true;
    }
  }
  return false;
}

}  // namespace

std::span<const ParameterRow> parameter_table() { return table; }

ListedParameter next_of(std::string_view& list) {
  const std::size_t end = place_of(',', list);
  const std::string_view both = list.substr(0, end);
  list.remove_prefix(std::min(end + 2, list.size()));
  const std::size_t blank = place_of(' ', both);
  return {both.substr(0, blank), both.substr(std::min(blank + 1, both.size()))};
}

bool has_row(std::string_view statement, std::string_view kind) { return find_row(statement, kind) != nullptr; }

ParameterFate fate_of(std::string_view statement, std::string_view kind, std::string_view name) {
  const ParameterRow* const row = find_row(statement, kind);
  if (row == nullptr) {
    return ParameterFate::unknown;
  }
  return has(row->used, name)     ? ParameterFate::used
         : has(row->said, name)   ? ParameterFate::said
         : has(row->silent, name) ? ParameterFate::silent
                                  : ParameterFate::unknown;
}

}  // namespace dmpc::apps::pbrt
