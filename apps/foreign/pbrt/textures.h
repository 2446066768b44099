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

/// A colour, multiplied by a picture if there is one.
struct TextureValue {
  core::Vec3d color{1, 1, 1};
  std::optional<TextureUse> picture;
  TexturePlace place;
};

/// The value that replaces a number given by a picture, since such pictures are not read.
inline constexpr double number_of_picture = 0.5;

class Textures {
 public:
  Textures(Notes& notes, std::vector<MadePicture>& pictures) : notes_(notes), pictures_(pictures) {}

  /// Adds a Texture statement. Throws core::InputError for textures that pbrt-v4 does not have, and for a duplicate name.
  void add(const std::string& name, const std::string& type, const std::string& kind, const Parameters& parameters);

  /// Returns a parameter's colour, given as a texture or directly. Throws core::InputError for an undefined texture.
  TextureValue color(const Parameters& parameters, const char* name, const core::Vec3d& fallback, SpectrumUse use) const;
  std::optional<TextureValue> color(const Parameters& parameters, const char* name, SpectrumUse use) const;

  /// Returns a parameter's number, or nothing if the statement does not have it.
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
