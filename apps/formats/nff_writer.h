// Writes scenes as NFF, Haines' neutral file format, like the SPD's own files.
#pragma once

#include <functional>
#include <iosfwd>
#include <string>

#include "core/scene/scene.h"

namespace dmpc::apps {

/// Writes each entity at once. A number has 6 significant digits (C's %g) if that is exact, else as many as it needs, so that
/// reading gives back the same doubles. The stream's state says whether writing succeeded.
class NffWriter final : public core::SceneSink {
 public:
  /// `output` must outlive the writer.
  explicit NffWriter(std::ostream& output) : output_(output) {}

  void background(const core::Vec3d& color) override;
  void view(const core::View& view) override;
  void light(const core::PointLight& light) override;
  void material(const core::Material& material) override;
  void polygon(const std::vector<core::Vec3d>& vertices) override;
  void patch(const std::vector<core::Vec3d>& vertices, const std::vector<core::Vec3d>& normals) override;
  void sphere(const core::Vec3d& center, double radius) override;
  void cone(const core::Vec3d& base, double base_radius, const core::Vec3d& apex, double apex_radius) override;

 private:
  void add(double value);
  void add(const core::Vec3d& v);
  void keyword(const char* word) { line_ += word; }
  void count(std::size_t value);
  void end_line();

  std::ostream& output_;
  std::string line_;
};

/// Writes the entities of `produce` to the file `path`: under a temporary name in the same folder, renamed at the end, so that no
/// half-written file is left. Throws core::InputError if it cannot be written; then, and when `produce` throws, the temporary
/// file is removed.
void write_nff_file(const std::string& path, const std::function<void(core::SceneSink&)>& produce);

}  // namespace dmpc::apps
