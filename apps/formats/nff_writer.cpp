#include "apps/formats/nff_writer.h"

#include <array>
#include <charconv>

#include "apps/frontend/system/output_file.h"
#include "core/base/expect.h"

namespace dmpc::apps {
void NffWriter::add(double value) {
  std::array<char, 40> text{};
  char* const first = text.data();
  char* const last = first + text.size();
  auto written = std::to_chars(first, last, value, std::chars_format::general, 6);
  double read = 0;
  std::from_chars(first, written.ptr, read);
  if (read != value) {
    written = std::to_chars(first, last, value);
  }
  line_ += ' ';
  line_.append(first, written.ptr);
}

void NffWriter::add(const core::Vec3d& v) {
  add(v.x);
  add(v.y);
  add(v.z);
}

void NffWriter::count(std::size_t value) { line_ += ' ' + std::to_string(value); }

/// A line that begins with a number begins with a blank until here.
void NffWriter::end_line() {
  line_ += '\n';
  const std::size_t start = line_.front() == ' ' ? 1 : 0;
  output_.write(line_.data() + start, static_cast<std::streamsize>(line_.size() - start));
  line_.clear();
}

void NffWriter::background(const core::Vec3d& color) {
  keyword("b");
  add(color);
  end_line();
}

void NffWriter::view(const core::View& view) {
  keyword("v\nfrom");
  add(view.from);
  keyword("\nat");
  add(view.at);
  keyword("\nup");
  add(view.up);
  keyword("\nangle");
  add(view.angle_degrees);
  keyword("\nhither");
  add(view.hither);
  keyword("\nresolution");
  count(static_cast<std::size_t>(view.width));
  count(static_cast<std::size_t>(view.height));
  end_line();
}

void NffWriter::light(const core::PointLight& light) {
  keyword("l");
  add(light.position);
  if (light.has_color) {
    add(light.color);
  }
  end_line();
}

void NffWriter::material(const core::Material& material) {
  keyword("f");
  add(material.color);
  for (const double value :
       {material.diffuse, material.specular, material.shine, material.transmittance, material.refraction_index}) {
    add(value);
  }
  end_line();
}

void NffWriter::polygon(const std::vector<core::Vec3d>& vertices) {
  keyword("p");
  count(vertices.size());
  end_line();
  for (const core::Vec3d& vertex : vertices) {
    add(vertex);
    end_line();
  }
}

void NffWriter::patch(const std::vector<core::Vec3d>& vertices, const std::vector<core::Vec3d>& normals) {
  keyword("pp");
  count(vertices.size());
  end_line();
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    add(vertices[i]);
    add(normals[i]);
    end_line();
  }
}

void NffWriter::sphere(const core::Vec3d& center, double radius) {
  keyword("s");
  add(center);
  add(radius);
  end_line();
}

void NffWriter::cone(const core::Vec3d& base, double base_radius, const core::Vec3d& apex, double apex_radius) {
  keyword("c");
  add(base);
  add(base_radius);
  add(apex);
  add(apex_radius);
  end_line();
}

void write_nff_file(const std::string& path, const std::function<void(core::SceneSink&)>& produce) {
  OutputFile file(path);
  NffWriter writer(file.stream());
  produce(writer);
  file.commit();
}

}  // namespace dmpc::apps
