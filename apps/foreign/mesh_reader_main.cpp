// The program dmpc_mesh_reader: reads mesh files for dmpc, which starts it.

#include <optional>
#include <string>

#include "apps/foreign/asked_files.h"
#include "apps/foreign/mesh_reader.h"
#include "apps/foreign/service.h"
#include "apps/formats/scene_blocks.h"
#include "core/base/expect.h"

namespace dmpc::apps {
namespace {

template <class T>
std::optional<T> take_choice(Unpacker& fields) {
  const bool has_value = fields.take_flag();
  const auto value = fields.take<double>();
  return has_value ? std::optional<T>(static_cast<T>(value)) : std::nullopt;
}

std::optional<UpAxis> take_up(Unpacker& fields) {
  const std::optional<std::size_t> axis = take_choice<std::size_t>(fields);
  const bool is_negative = fields.take_flag();
  return axis ? std::optional(UpAxis{*axis, is_negative}) : std::nullopt;
}

std::optional<Resolution> take_size(Unpacker& fields) {
  const std::optional<int> width = take_choice<int>(fields);
  const auto height = static_cast<int>(fields.take<double>());
  return width ? std::optional(Resolution{*width, height}) : std::nullopt;
}

AnimationMoment take_moment(Unpacker& fields) {
  AnimationMoment moment{.name = fields.take_text()};
  moment.seconds = fields.take<double>();
  moment.frames_per_second = fields.take<double>();
  if (fields.take_flag()) {
    const auto center = fields.take<core::Vec3d>();
    const auto radius = fields.take<double>();
    moment.still = StillScene{{center, radius}, fields.take<core::View>()};
  }
  return moment;
}

MeshOptions take_options(Unpacker& fields) {
  MeshOptions options;
  options.scale = take_choice<double>(fields);
  options.up = take_up(fields);
  options.smooth_degrees = take_choice<double>(fields);
  options.size = take_size(fields);
  options.allows_missing = fields.take_flag();
  options.is_seen_otherwise = fields.take_flag();
  options.is_lit_otherwise = fields.take_flag();
  options.is_below_sky = fields.take_flag();
  options.is_below_own_sky = fields.take_flag();
  options.is_by_paths = fields.take_flag();
  options.copies = fields.take_flag() ? core::Copies::left_out : core::Copies::put;
  if (!fields.is_empty()) {
    options.animation = take_moment(fields);
  }
  return options;
}

void serve_mesh(const Message& request, Line& line) {
  core::expect(request.saying == Saying::read_mesh, "a reader of mesh files is asked for mesh files");
  Unpacker fields(request.bytes);
  const std::string path = fields.take_text();
  const auto memory_bytes = fields.take<std::uint64_t>();
  const MeshOptions options = take_options(fields);
  AskedFiles files(line, memory_bytes);
  MeshScene mesh = read_mesh(path, options, files);
  for (const std::string& note : mesh.notes) {
    line.send(Saying::note, Packer().add_text(note));
  }
  if (options.animation) {
    line.send(Saying::bounds, Packer().add(mesh.bounds.center).add(mesh.bounds.radius));
  }
  for (const FileSky& sky : options.is_below_own_sky ? mesh.skies : std::vector<FileSky>()) {
    Packer fields_of_sky;
    fields_of_sky.add_text(sky.path);
    for (const core::Vec3d& vector : {sky.rows[0], sky.rows[1], sky.rows[2], sky.scale}) {
      fields_of_sky.add(vector);
    }
    line.send(Saying::sky, fields_of_sky);
  }
  if (send_scene(mesh.scene, mesh.vertices, mesh.instances, line, Handing::from_memory)) {
    line.send(Saying::done);
  }
}

}  // namespace
}  // namespace dmpc::apps

int main() { dmpc::apps::serve_requests(dmpc::apps::serve_mesh); }
