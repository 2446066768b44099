// Textures of a pbrt scene, by name.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "apps/foreign/mesh/count_note.h"
#include "apps/foreign/mesh/placed_file.h"
#include "apps/foreign/pbrt/parameters.h"
#include "apps/foreign/pbrt/spectra.h"

namespace dmpc::apps::pbrt {

/// A colour, times that of a picture if there is one.
struct TextureValue {
  core::Vec3d color{1, 1, 1};
  std::optional<TextureUse> picture;
  TexturePlace place;
};

/// Numbers by texture are told by what stands for them: a picture's are not read here.
inline constexpr double number_of_picture = 0.5;

class Textures {
 public:
  Textures(Notes& notes, std::vector<MadePicture>& pictures) : notes_(notes), pictures_(pictures) {}

  /// A Texture statement. Throws core::InputError for what pbrt-v4 does not have, and for a second one of this name.
  void add(const std::string& name, const std::string& type, const std::string& kind, const Parameters& parameters);

  /// A parameter's colour, by texture or by itself. Throws core::InputError for a texture that has not been added.
  TextureValue color(const Parameters& parameters, const char* name, const core::Vec3d& fallback, SpectrumUse use) const;
  std::optional<TextureValue> color(const Parameters& parameters, const char* name, SpectrumUse use) const;

  /// A parameter's number; nothing where the statement has none.
  std::optional<double> number(const Parameters& parameters, const char* name) const;

 private:
  TextureValue value_of(const std::string& kind, const Parameters& parameters, bool is_number);
  TextureValue part(const Parameters& parameters, const char* name, double fallback, bool is_number) const;
  TextureValue scaled(const Parameters& parameters, bool is_number);
  TextureValue mixed(const Parameters& parameters, bool is_number);
  TextureValue dotted(const Parameters& parameters, bool is_number);
  TextureValue checkered(const Parameters& parameters, bool is_number);
  TextureValue pictured(const Parameters& parameters);
  void place(const Parameters& parameters, TextureValue& value, double span = 1);
  const TextureValue& find(const Parameter& parameter, const Parameters& owner, bool is_number) const;

  Notes& notes_;
  std::vector<MadePicture>& pictures_;
  std::map<std::string, TextureValue> colors_, numbers_;
};

}  // namespace dmpc::apps::pbrt
