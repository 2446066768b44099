#include "apps/show/stats/stats.h"

#include <cstdint>
#include <initializer_list>
#include <numeric>
#include <optional>
#include <variant>

#include "apps/frontend/line/json_format.h"
#include "apps/frontend/line/number_text.h"
#include "apps/frontend/machine/machine_file.h"
#include "apps/frontend/show/stats/counters_json.h"
#include "apps/reader/confinement.h"
#include "apps/run/memory_categories.h"
#include "apps/run/strategy_rows.h"
#include "apps/show/counters.h"
#include "apps/show/heat/field.h"
#include "apps/show/stats/strategy.h"
#include "apps/show/stats/virtual.h"
#include "core/base/expect.h"
#include "core/database/shading/material_records.h"

namespace dmpc::apps {

namespace {

using nodes::Traffic;

constexpr double nanosecond = 1e-9;

/// Returns all of `keys` in order, null if `values` does not have them.
Json filled(std::initializer_list<const char*> keys, const Json& values) {
  Json result;
  for (const char* const key : keys) {
    result[key] = nullptr;
  }
  for (const auto& [key, value] : values.items()) {
    core::expect(result.contains(key), "a strategy adds no key of its own");
    result[key] = value;
  }
  return result;
}

/// Returns how samples were distributed.
Json sampling_json(const RenderRecord& record, const Account& account) {
  const std::uint64_t samples = account.film.samples();
  Json result = {{"samples", samples},
                 {"resumed", record.samples_found_done},
                 {"samples_per_pixel", static_cast<double>(samples) / static_cast<double>(account.film.pixel_count())},
                 {"passes", account.refinement.passes}};
  result["estimated_error"] = record.options.picture.is_refined ? Json(account.refinement.error) : Json();
  return result;
}

/// Returns a figure of the whole picture that a part of its samples does not determine: null if some samples came from an earlier
/// run.
Json of_whole_picture(const RenderRecord& record, const Json& figure) { return record.samples_found_done == 0 ? figure : Json(); }

/// Bound of the cutoff: on average a sample lacks at most this much light.
Json cutoff_json(const RenderRecord& record, const Account& account) {
  const RenderOptions& options = record.options;
  const auto cut = static_cast<double>(account.operations.rays_cut);
  return {
      {"on", options.picture.cutoff > 0},
      {"exact", false},
      {"cutoff", options.picture.cutoff},
      {"rays_cut", account.operations.rays_cut},
      {"mean_error_bound", of_whole_picture(record, options.picture.cutoff * cut / static_cast<double>(account.film.samples()))}};
}

/// Returns what was skipped.
Json skips_json(const RenderRecord& record, const Account& account) {
  const RenderOptions& options = record.options;
  Json result;
  for (const core::Skip& skip : core::all_skips) {
    result[key_of(skip.name)] = {{"on", options.picture.skips.*skip.is_on},
                                 {"exact", true},
                                 {"avoided", account.operations.skipped.*skip.avoided},
                                 {"unit", skip.unit}};
  }
  result["equal_frames"] = {{"on", options.picture.skips_equal_frames},
                            {"exact", true},
                            {"avoided", record.copied_frame ? 1 : 0},
                            {"unit", "frames"},
                            {"copied_frame", record.copied_frame ? Json(*record.copied_frame) : Json()}};
  result["cutoff"] = cutoff_json(record, account);
  return result;
}

Json packets_json(const nodes::NodeCounters& counters) {
  const Traffic sent = nodes::total(counters.sent);
  const Traffic received = nodes::total(counters.received);
  return {{"sent", sent.packets},
          {"received", received.packets},
          {"bytes", sent.bytes},
          {"bytes_received", received.bytes},
          {"refused", counters.refused}};
}

Json all_packets_json(const Account& account, std::uint64_t packets_overflowed) {
  const Traffic total = nodes::total(account.sent);
  std::uint64_t received = nodes::total(account.host.received).packets;
  for (const NodeAccount& node : account.nodes) {
    received += nodes::total(node.counters.received).packets;
  }
  Json by_kind;
  for (std::size_t kind = 0; kind < account.kind_names.size(); ++kind) {
    by_kind[account.kind_names[kind]] = {{"packets", account.sent[kind].packets}, {"bytes", account.sent[kind].bytes}};
  }
  return {{"sent", total.packets},
          {"received", received},
          {"bytes", total.bytes},
          {"overflow", packets_overflowed},
          {"by_kind", by_kind}};
}

Json memory_json(const nodes::MemoryPlan& memory) {
  Json result;
  for (const auto& [category, name] : memory_categories) {
    result[key_of(name)] = memory[category];
  }
  result["total"] = memory.total();
  return result;
}

/// Returns the effects of a seed on the computer, or null without one.
Json chaos_json(const Account& account, const Json& credits) {
  if (!account.chaos) {
    return nullptr;
  }
  std::uint64_t held = account.host.held, sat_out = account.host.sat_out;
  for (const NodeAccount& node : account.nodes) {
    held += node.counters.held;
    sat_out += node.counters.sat_out;
  }
  Json result = {{"seed", account.chaos->seed}, {"packets_delayed", held}, {"quanta_sat_out", sat_out}};
  result.update(filled({"request_credits", "ray_credits", "host_credits", "film_credits"}, credits));
  return result;
}

Json node_seconds_json(const nodes::NodeCounters& counters) {
  // The clocks differ, so a node that never waited may appear busy for longer than it ran.
  const std::uint64_t accounted_ns = counters.busy_ns + counters.asleep_ns;
  const std::uint64_t waiting_ns = counters.wall_ns > accounted_ns ? counters.wall_ns - accounted_ns : 0;
  return {{"busy", static_cast<double>(counters.busy_ns) * nanosecond},
          {"idle", static_cast<double>(counters.asleep_ns) * nanosecond},
          {"waiting", static_cast<double>(waiting_ns) * nanosecond},
          {"wall", static_cast<double>(counters.wall_ns) * nanosecond}};
}

/// `timed`: the additions of a run in virtual time, whose nodes have no wall clock time.
Json node_json(const NodeAccount& node, const Json& special, const Json& timed) {
  Json result = {{"rays", rays_json(node.operations.rays)},
                 {"hits", json_of(node.operations, hit_counters)},
                 {"operations", json_of(node.operations)},
                 {"packets", packets_json(node.counters)}};
  result.update(filled({"pages", "work", "questions", "travel", "load", "region"}, special));
  result["memory"] = {{"planned", memory_json(node.memory_planned)}, {"used", memory_json(node.memory_used)}};
  result["seconds"] = timed.empty() ? node_seconds_json(node.counters) : Json();
  result.update(filled({"virtual_seconds", "time_percent"}, timed));
  result["quanta"] = node.counters.quanta;
  result["sleeps"] = node.counters.sleeps;
  return result;
}

Json nodes_json(const Account& account, const StrategyStats& special, const VirtualStats& timed) {
  Json result = Json::array();
  for (std::size_t i = 0; i < account.nodes.size(); ++i) {
    result.push_back(node_json(account.nodes[i], special.nodes[i], timed.nodes[i]));
  }
  return result;
}

Json host_json(const RenderRecord& record, const Account& account, const Json& special, const Json& timed) {
  Json result = {{"packets", packets_json(account.host)},
                 {"deposits_saturated", of_whole_picture(record, account.host_deposits_saturated)},
                 {"seconds", timed.empty() ? node_seconds_json(account.host) : Json()},
                 {"sleeps", account.host.sleeps}};
  result.update(filled({"virtual_seconds"}, timed));
  result.update(filled({"pages_served", "rays_buffered_max", "buffered_bytes_max", "token_rounds"}, special));
  return result;
}

/// Adds the scene's transformation, view and lights as on the command line; null if not given.
void add_scene_setup(Json& options, const SceneSetup& scene_setup) {
  const MeshOptions& mesh = scene_setup.mesh;
  options["camera"] = scene_setup.camera ? Json(text_of(*scene_setup.camera)) : Json();
  options["light"] = nullptr;
  for (const core::PointLight& light : scene_setup.lights) {
    options["light"].push_back(text_of(light));
  }
  options["fill"] = scene_setup.fill ? Json(*scene_setup.fill) : Json();
  options["ambient"] = scene_setup.ambient ? Json(text_of(*scene_setup.ambient)) : Json();
  options["background"] = scene_setup.background ? Json(text_of(*scene_setup.background)) : Json();
  options["scale"] = mesh.scale ? Json(*mesh.scale) : Json();
  options["up"] = mesh.up ? Json(text_of(*mesh.up)) : Json();
  options["smooth"] = mesh.smooth_degrees ? Json(*mesh.smooth_degrees) : Json();
  options["missing"] = mesh.allows_missing ? Json("plain") : Json();
}

struct JsonOf {
  Json operator()(std::monostate) const { return nullptr; }
  template <class Value>
  Json operator()(const Value& value) const {
    return value;
  }
};

Json options_json(const RenderRecord& record, const Account& account) {
  const RenderOptions& options = record.options;
  const bool by_paths = options.picture.transport.is_by_paths();
  const bool has_voxels = options.database.build.structure == core::Structure::voxels;
  Json result = {
      {"scene", options.picture.scene},
      {"width", account.film.width()},
      {"height", account.film.height()},
      {"samples", options.picture.is_refined ? Json("auto") : Json(options.picture.samples)},
      {"error", options.picture.is_refined ? Json(options.picture.refinement.error) : Json()},
      {"samples_max", options.picture.is_refined ? Json(options.picture.refinement.samples_max) : Json()},
      {"cutoff", options.picture.cutoff},
      {"depth", options.picture.depth},
      {"convention", options.picture.convention == core::Convention::haines ? "haines" : "paper"},
      {"transport", name_of(options.picture.transport.kind)},
      {"bounces", by_paths ? Json(options.picture.depth - 1) : Json()},
      {"sky", options.picture.transport.sky ? Json(text_of(*options.picture.transport.sky)) : Json()},
      {"emitters", by_paths ? Json(options.picture.transport.emitters) : Json()},
      {"light_radius", options.picture.transport.light_radius ? Json(*options.picture.transport.light_radius) : Json()},
      {"clamp", options.picture.transport.clamp > 0 ? Json(options.picture.transport.clamp) : Json()},
      {"tracer", options.tracer == TracerChoice::grid ? "grid" : "embree"},
      {"record_order", name_of(options.database.build.record_order)},
      {"structure", name_of(options.database.build.structure)},
      {"voxels", has_voxels ? Json(text_of(options.database.build.voxels)) : Json()},
      {"instances", options.database.build.keeps_instances ? "keep" : "expand"},
      {"system", options.system ? Json(name_of(*options.system)) : Json()},
      {"strategy", name_of(options.strategy)},
      {"nodes", account.nodes.size()},
      {"pool_threads", options.computer.pool_threads ? Json(*options.computer.pool_threads) : Json()},
      {"node_memory", account.node_memory_max_bytes},
      {"page_size", record.database.page_size()}};
  add_scene_setup(result, options.picture.scene_setup);
  const auto reported =
      std::visit([&](const auto& report) { return reported_options(options.strategy, report.plan); }, record.report);
  for (const auto& [key, value] : reported) {
    result[std::string(key)] = std::visit(JsonOf(), value);
  }
  return result;
}

Json seconds_json(const Seconds& seconds) {
  return {{"load", seconds.load},
          {"build", seconds.build},
          {"prepare", seconds.prepare},
          {"render", seconds.render},
          {"write", seconds.write},
          {"user", seconds.user},
          {"system", seconds.system},
          {"render_user", seconds.render_user},
          {"render_system", seconds.render_system}};
}

Json heat_maps_json(const RenderRecord& record) {
  Json result;
  for (const HeatRequest& request : record.options.heat_maps) {
    const HeatField field = heat_field(request.kind, record);
    result.push_back({{"kind", core::name_of(field.kind)},
                      {"file", request.path.string()},
                      {"unit", field.unit},
                      {"clock", field.clock.empty() ? Json() : Json(field.clock)},
                      {"repeatable", field.is_repeatable},
                      {"least", field.least()},
                      {"largest", field.largest()},
                      {"sum", field.sum()}});
  }
  return result;
}

/// Confinement of this run's readers of foreign files.
Json sandbox_json() {
  const std::optional<Confinement> confinement = confinement_of_readers();
  return confinement ? Json{{"calls_filtered", confinement->are_calls_filtered},
                            {"limits_set", confinement->are_limits_set},
                            {"files_forbidden", confinement->are_files_forbidden},
                            {"reach_forbidden", confinement->is_reach_forbidden},
                            {"end_with_dmpc", confinement->ends_with_dmpc}}
                     : Json();
}

/// Returns where the finest cells, in which regions are counted, lie in the scene.
Json grid_json(const core::GridFrame& frame) {
  const auto in_scene = [&](std::size_t axis) { return frame.origin[axis] + frame.low[axis] / frame.scale; };
  return {{"low", {in_scene(0), in_scene(1), in_scene(2)}}, {"cell", double{frame.finest_cell} / frame.scale}};
}

Json database_json(const core::Database& database) {
  const core::RecordCounts& records = database.records();
  const auto leaf_count = [&](core::PrimitiveKind kind) { return records.leaves[static_cast<std::size_t>(kind)]; };
  return {{"bytes", database.page_count() * database.page_size()},
          {"pages", database.page_count()},
          {"page_size", database.page_size()},
          {"forest_pages", database.forest_page_count()},
          {"primitives", database.header().primitive_count},
          {"references", database.references()},
          {"dropped", database.dropped()},
          {"collapsed", database.collapsed().size()},
          {"bvh_nodes", records.bvh_nodes},
          {"voxel_references", records.voxel_references},
          {"triangle_leaves", leaf_count(core::PrimitiveKind::triangle)},
          {"sphere_leaves", leaf_count(core::PrimitiveKind::sphere)},
          {"cone_leaves", leaf_count(core::PrimitiveKind::cone)},
          {"normals", records.normals},
          {"textured", records.textured},
          {"texture_tiles", records.texture_tiles},
          {"materials", records.materials},
          {"lights", database.header().light_count},
          {"emitters", database.header().emitter_count},
          {"sky_tiles", records.sky_tiles},
          {"grid", grid_json(database.header().frame)},
          {"instancing",
           {{"meshes", records.base_meshes},
            {"instances", records.instances},
            {"triangles", records.base_mesh_triangles},
            {"placed_triangles", records.triangles_in_places}}}};
}

}  // namespace

Json rays_json(const std::array<std::uint64_t, core::ray_kind_count>& rays) {
  const auto count = [&](core::RayKind kind) { return rays[static_cast<std::size_t>(kind)]; };
  return {{"primary", count(core::RayKind::primary)},     {"reflected", count(core::RayKind::reflected)},
          {"refracted", count(core::RayKind::refracted)}, {"shadow", count(core::RayKind::shadow)},
          {"scattered", count(core::RayKind::scattered)}, {"total", std::accumulate(rays.begin(), rays.end(), std::uint64_t{0})}};
}

std::string stats_json(const RenderRecord& record) {
  const Account account = account_of(record.report);
  const VirtualStats timed = virtual_stats(account, record.film_hash());
  const std::optional<nodes::Machine>& machine = record.options.computer.machine;
  const StrategyStats special =
      std::visit([&](const auto& report) { return strategy_stats(record.options, report); }, record.report);
  Json all = {{"format", json_format},
              {"program", "dmpc " DMPC_VERSION},
              {"options", options_json(record, account)},
              {"runner", name_of(record.options.runner.kind)},
              {"machine", machine ? machine_json(*machine) : Json()},
              {"film_hash", hash_text(record.film_hash())},
              {"film_scale", account.film.scale().factor()},
              {"sampling", sampling_json(record, account)},
              {"rays", rays_json(account.operations.rays)},
              {"hits", json_of(account.operations, hit_counters)},
              {"operations", json_of(account.operations)},
              {"seconds", seconds_json(record.seconds)}};
  all["operations"]["deposits_saturated"] = of_whole_picture(record, account.operations.deposits_saturated);
  all.update(filled({"run_hash", "machine_digest", "virtual_seconds", "time_percent", "events", "links"}, timed.all));
  all.update({{"database", database_json(record.database)}, {"packets", all_packets_json(account, special.packets_overflowed)}});
  all.update(filled({"pages", "work", "questions", "travel", "load", "regions", "mapping", "pairs"}, special.all));
  all["sandbox"] = sandbox_json();
  all["chaos"] = chaos_json(account, special.chaos);
  all["skips"] = skips_json(record, account);
  all["heat_maps"] = heat_maps_json(record);
  all["nodes"] = nodes_json(account, special, timed);
  all["ranks"] = ranks_json(account.ranks, record.options.trace.path || record.options.report);
  all["host"] = host_json(record, account, special.host, timed.host);
  return all.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";  // names of files may be invalid UTF-8
}

}  // namespace dmpc::apps
