#include "apps/lab/bench/speed/pov_file.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "core/base/expect.h"

namespace dmpc::apps {
namespace {

using core::Color;
using core::Vec3d;
using core::Vec3f;

class PovText {
 public:
  PovText& operator<<(std::string_view words) {
    text_ += words;
    return *this;
  }
  PovText& operator<<(double number) {
    std::array<char, 32> digits{};
    text_.append(digits.data(), std::to_chars(digits.begin(), digits.end(), number, std::chars_format::scientific, 9).ptr);
    return *this;
  }
  PovText& operator<<(const Vec3d& vector) { return *this << "<" << vector.x << "," << vector.y << "," << vector.z << ">"; }
  PovText& operator<<(const Vec3f& vector) { return *this << Vec3d(vector); }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

/// By their material's number.
using Groups = std::map<std::uint32_t, std::vector<unsigned>>;

class PovWriter {
 public:
  explicit PovWriter(const PlainStage& stage) : stage_(stage), primitives_(stage.tree().shapes().primitives) {}

  std::string text() {
    add_head();
    for (std::size_t i = 0; i < stage_.materials().size(); ++i) {
      add_material(i);
    }
    Groups triangles, curved;
    for (unsigned triangle = 0; triangle < stage_.triangle_count(); ++triangle) {
      const core::PatchNormals* const normals = stage_.normals_of(triangle);
      triangles[normals != nullptr ? normals->material() : stage_.flat_material_of(triangle)].push_back(triangle);
    }
    for (const auto& [material, members] : triangles) {
      add_mesh(material, members);
    }
    for (unsigned index = 0; index < stage_.tree().shapes().curved.size(); ++index) {
      add_curved(index);
    }
    return text_.text();
  }

 private:
  void add_head() {
    const PlainCamera& camera = stage_.camera();
    const core::RenderSettings& settings = stage_.settings();
    const auto width = static_cast<float>(settings.camera.width()), height = static_cast<float>(settings.camera.height());
    const Vec3f middle = camera.corner + camera.right * (0.5F * (width - 1)) + camera.down * (0.5F * (height - 1));
    text_ << "#version 3.7;\nglobal_settings { assumed_gamma 1 adc_bailout 0 max_trace_level "
          << static_cast<double>(settings.shade.depth_max) << " }\n#default { finish { ambient 0 diffuse 1 } }\n"
          << "background { color rgb " << settings.header.background << " }\ncamera { perspective location " << camera.eye
          << " direction " << middle << " right " << camera.right * width << " up " << -(camera.down * height) << " }\n";
    for (const core::LightRecord& light : stage_.lights()) {
      text_ << "light_source { " << light.position << " color rgb " << light.intensity << " }\n";
    }
  }

  /// POV-Ray weighs what is diffuse by what is not transmitted.
  void add_material(std::size_t i) {
    const PlainMaterial& material = stage_.materials()[i];
    const float left = 1 - material.transmittance;
    const Color diffuse = left > 0 ? material.color * (material.diffuse / left) : Color{};
    text_ << "#declare M" << std::to_string(i) << " = texture { pigment { color rgb " << diffuse;
    if (is_transmitting(i)) {
      text_ << " transmit " << double{material.transmittance};
    }
    text_ << " } finish {";
    if (material.is_glossy()) {
      text_ << " phong " << double{std::max({material.highlight.x, material.highlight.y, material.highlight.z})} << " phong_size "
            << double{material.shine} << " reflection { rgb " << material.highlight * material.mirror << " }";
    }
    text_ << " } }\n";
  }

  bool is_transmitting(std::size_t material) const { return stage_.materials()[material].transmittance > 0; }

  void add_mesh(std::uint32_t material, const std::vector<unsigned>& triangles) {
    const auto add_triangles = [&] {
      text_ << "mesh {\n";
      for (const unsigned triangle : triangles) {
        add_triangle(triangle);
      }
    };
    add_triangles();
    add_looks(material);
    if (is_transmitting(material)) {
      add_triangles();
      add_shadow();
    }
  }

  void add_triangle(unsigned triangle) {
    const core::PrimitiveValues& values = primitives_[stage_.tree().shapes().triangles[triangle]];
    const core::PatchNormals* const normals = stage_.normals_of(triangle);
    const bool is_smooth = normals != nullptr && !(normals->normal[0] == Vec3f{});
    text_ << (is_smooth ? "smooth_triangle {" : "triangle {");
    for (std::size_t corner = 0; corner < 3; ++corner) {
      text_ << (corner == 0 ? "" : ",") << values.vector(3 * corner);
      if (is_smooth) {
        text_ << "," << normals->normal[corner];
      }
    }
    text_ << "}\n";
  }

  void add_curved(unsigned index) {
    const core::PrimitiveValues& values = primitives_[stage_.tree().shapes().curved[index]];
    const std::uint32_t material = stage_.material_of_curved(index);
    add_shape(values.curved(), values.kind);
    add_looks(material);
    if (is_transmitting(material)) {
      add_shape(values.curved(), values.kind);
      add_shadow();
    }
  }

  void add_shape(const core::CurvedValues& values, core::PrimitiveKind kind) {
    if (kind == core::PrimitiveKind::sphere) {
      text_ << "sphere { " << values.vector(0) << ", " << std::fabs(values.value(3));
    } else {
      text_ << "cone { " << values.vector(0) << ", " << std::fabs(values.value(3)) << ", " << values.apex() << ", "
            << std::fabs(values.value(7)) << " open";
    }
  }

  void add_looks(std::uint32_t material) {
    text_ << " texture { M" << std::to_string(material) << " }";
    if (is_transmitting(material)) {
      text_ << " interior { ior " << double{stage_.materials()[material].inside_index()} << " } no_shadow";
    }
    text_ << " }\n";
  }

  void add_shadow() { text_ << " texture { pigment { color rgb 0 } } no_image no_reflection }\n"; }

  const PlainStage& stage_;
  std::span<const core::PrimitiveValues> primitives_;
  PovText text_;
};

/// Words and numbers of a PPM file's head.
class PpmHead {
 public:
  explicit PpmHead(std::string_view bytes) : bytes_(bytes) {}

  std::string_view next_word() {
    skip();
    const std::size_t first = at_;
    while (at_ < bytes_.size() && !is_space(bytes_[at_])) {
      ++at_;
    }
    return bytes_.substr(first, at_ - first);
  }
  /// 0 if there is none.
  std::size_t next_number() {
    const std::string_view word = next_word();
    std::size_t number = 0;
    std::from_chars(word.data(), word.data() + word.size(), number);
    return number;
  }
  /// Behind the one white space that ends the head.
  std::string_view rest() const { return bytes_.substr(std::min(at_ + 1, bytes_.size())); }

 private:
  static bool is_space(char letter) { return letter == ' ' || letter == '\n' || letter == '\t' || letter == '\r'; }
  /// White space and remarks.
  void skip() {
    while (at_ < bytes_.size() && (is_space(bytes_[at_]) || bytes_[at_] == '#')) {
      at_ = bytes_[at_] == '#' ? std::min(bytes_.find('\n', at_), bytes_.size()) : at_ + 1;
    }
  }

  std::string_view bytes_;
  std::size_t at_ = 0;
};

}  // namespace

std::string pov_of(const PlainStage& stage) { return PovWriter(stage).text(); }

PlainPicture picture_in_ppm(std::string_view bytes) {
  constexpr std::size_t side_max = 1 << 16, highest = 65535, pixel_bytes = 6;
  PpmHead head(bytes);
  const bool is_ppm = head.next_word() == "P6";
  const std::size_t width = head.next_number(), height = head.next_number();
  const bool is_fine = head.next_number() == highest;
  const std::string_view samples = head.rest();
  if (!is_ppm || !is_fine || width > side_max || height > side_max || samples.size() != width * height * pixel_bytes) {
    throw core::InputError("a picture was expected to be a binary PPM file of 16 bits (P6, 65535), and is none or not whole");
  }
  PlainPicture picture{.pixels = core::ZeroedArray<Color>(width * height)};
  const auto sample = [&](std::size_t i) {
    const auto high = static_cast<unsigned char>(samples[2 * i]), low = static_cast<unsigned char>(samples[2 * i + 1]);
    return static_cast<float>(256 * high + low) / static_cast<float>(highest);
  };
  for (std::size_t i = 0; i < width * height; ++i) {
    picture.pixels[i] = {sample(3 * i), sample(3 * i + 1), sample(3 * i + 2)};
  }
  return picture;
}

}  // namespace dmpc::apps
