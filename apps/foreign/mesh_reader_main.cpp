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

/// As apps/formats/mesh_session.cpp packs them.
MeshOptions take_options(Unpacker& fields) {
  MeshOptions options;
  options.scale = fields.take_optional<double>();
  options.up = fields.take_optional<UpAxis>();
  options.smooth_degrees = fields.take_optional<double>();
  options.size = fields.take_optional<Resolution>();
  for (bool* const flag : {&options.allows_missing, &options.is_seen_otherwise, &options.is_lit_otherwise, &options.is_below_sky,
                           &options.is_below_own_sky, &options.is_by_paths}) {
    *flag = fields.take_flag();
  }
  options.copies = fields.take_choice(core::Copies::left_out);
  if (!fields.is_empty()) {
    AnimationMoment& moment = options.animation.emplace();
    moment.name = fields.take_text();
    moment.seconds = fields.take<double>();
    moment.frames_per_second = fields.take<double>();
    moment.still = fields.take_optional<StillScene>();
  }
  return options;
}

void serve_mesh(const Message& request, Line& line) {
  core::expect(request.saying == Saying::read_mesh, "a reader of mesh files is asked for mesh files");
  Unpacker fields(request.bytes);
  const std::string path = fields.take_text();
  const auto memory_bytes = fields.take<std::uint64_t>();
  const MeshOptions options = take_options(fields);
  AskedFiles files(line, SceneTotals(memory_bytes, options.smooth_degrees ? core::Copies::put : options.copies));
  MeshScene mesh = read_mesh(path, options, files);
  for (const std::string& note : mesh.notes) {
    line.send(Saying::note, Packer().add_text(note));
  }
  if (options.animation) {
    line.send(Saying::bounds, Packer().add(mesh.bounds.center).add(mesh.bounds.radius).add(mesh.light_share));
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
