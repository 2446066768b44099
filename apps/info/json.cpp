#include "apps/info/json.h"

#include <nlohmann/json.hpp>
#include <numeric>

#include "apps/frontend/line/json_format.h"
#include "apps/info/record.h"
#include "apps/run/strategy_options.h"
#include "apps/scene/scene_setup.h"

namespace dmpc::apps {

namespace {

using Json = nlohmann::ordered_json;

Json vector_json(const core::Vec3d& vector) { return {vector.x, vector.y, vector.z}; }

Json objects_json(const SceneFigures& scene) {
  Json result;
  for (std::size_t kind = 0; kind < core::object_kind_count; ++kind) {
    result[name_of(static_cast<core::ObjectKind>(kind))] = scene.objects[kind];
  }
  result["total"] = std::accumulate(scene.objects.begin(), scene.objects.end(), std::uint64_t{0});
  return result;
}

Json bounds_json(const core::Box& bounds) {
  if (bounds.empty()) {
    return nullptr;
  }
  return {
      {"low", vector_json(bounds.low)}, {"high", vector_json(bounds.high)}, {"extent", vector_json(bounds.high - bounds.low)}};
}

Json view_json(const InfoRecord& record) {
  const core::View& view = record.scene.view;
  return {{"camera", text_of(camera_of(view))},
          {"from", vector_json(view.from)},
          {"at", vector_json(view.at)},
          {"up", vector_json(view.up)},
          {"degrees", view.angle_degrees},
          {"width", record.width},
          {"height", record.height}};
}

Json lights_json(const SceneFigures& scene) {
  Json result = Json::array();
  for (const core::PointLight& light : scene.lights) {
    result.push_back({{"light", text_of(light)}, {"position", vector_json(light.position)}, {"color", vector_json(light.color)}});
  }
  return result;
}

Json materials_json(const MaterialCounts& materials) {
  return {{"count", materials.count},
          {"mirroring", materials.mirroring},
          {"transmitting", materials.transmitting},
          {"textured", materials.textured}};
}

Json textures_json(const SceneFigures& scene) {
  Json result = Json::array();
  for (const TextureFigures& texture : scene.textures) {
    result.push_back({{"name", texture.name},
                      {"width", texture.width},
                      {"height", texture.height},
                      {"levels", texture.levels},
                      {"format", name_of(texture.format)},
                      {"tiles", texture.tiles},
                      {"tile_bytes", texture.tile_bytes},
                      {"table_bytes", texture.table_bytes}});
  }
  return result;
}

/// Returns null if no mesh has several instances.
Json meshes_json(const InfoRecord& record) {
  const MeshFigures& meshes = record.scene.meshes;
  if (meshes.places == 0) {
    return {};
  }
  const std::uint64_t here = record.database.bytes, otherwise = record.database.bytes_otherwise(meshes.stored_share);
  const bool are_instanced = record.database.instances > 0;
  return {{"count", meshes.count},
          {"places", meshes.places},
          {"triangles", meshes.triangles},
          {"placed_triangles", meshes.triangles_in_places},
          {"instances", record.database.instances},
          {"instanced_bytes", are_instanced ? here : otherwise},
          {"expanded_bytes", are_instanced ? otherwise : here}};
}

Json database_json(const DatabaseFigures& database) {
  Json records = Json::array();
  for (const RecordFigures& record : database.records) {
    records.push_back({{"kind", record.kind}, {"count", record.count}, {"bytes", record.bytes}});
  }
  const auto each = [&](double value) { return database.primitives == 0 ? Json() : Json(value); };
  return {{"bytes", database.bytes},
          {"pages", database.pages},
          {"page_size", database.page_size_bytes},
          {"bytes_per_primitive", each(database.bytes_each())},
          {"copies_per_primitive", each(database.copies_each())},
          {"primitives_per_leaf", each(database.primitives_a_leaf())},
          {"cells", database.cells},
          {"macro_cells", database.macro_cells},
          {"occupied_macro_cells", database.occupied_macro_cells},
          {"levels_max", database.levels_max},
          {"records", records},
          {"unused_bytes", database.unused_bytes}};
}

Json memory_json(const MemoryForecast& memory, std::uint32_t node_count) {
  return {{"least", memory.least_bytes},
          {"least_together", memory.least_bytes * node_count},
          {"usual", memory.usual_bytes},
          {"all", memory.all_bytes}};
}

Json computers_json(const Forecast& forecast) {
  Json result = Json::array();
  for (const ComputerForecast& computer : forecast.computers) {
    const auto& rays = computer.dataflow;
    result.push_back({{"nodes", computer.nodes},
                      {"svm", memory_json(computer.svm, computer.nodes)},
                      {"replicated", memory_json(computer.replicated, computer.nodes)},
                      {"dataflow", rays ? memory_json(*rays, computer.nodes) : Json()},
                      {"dataflow_copies", rays ? Json(computer.dataflow_copies) : Json()},
                      {"forest", computer.forest ? memory_json(*computer.forest, computer.nodes) : Json()}});
  }
  return result;
}

}  // namespace

std::string info_json(const InfoRecord& record) {
  const DatabaseFigures& database = record.database;
  const Json all = {
      {"format", json_format},
      {"program", "dmpc " DMPC_VERSION},
      {"scene", record.scene.name},
      {"objects", objects_json(record.scene)},
      {"primitives", {{"count", database.primitives}, {"dropped", database.dropped}, {"copies", database.copies}}},
      {"rounding",
       {{"moved", record.loss.moved},
        {"moved_pixels", record.loss.moved_pixels},
        {"collapsed", record.loss.collapsed},
        {"collapsed_pixels", record.loss.collapsed_pixels}}},
      {"bounds", bounds_json(record.scene.bounds)},
      {"view", view_json(record)},
      {"background", vector_json(record.scene.background)},
      {"lights", lights_json(record.scene)},
      {"materials", materials_json(record.scene.materials)},
      {"textures", textures_json(record.scene)},
      {"meshes", meshes_json(record)},
      {"database", database_json(database)},
      {"build_peak", record.build_peak_bytes},
      {"regions",
       {{"balance", name_of(record.forecast.balance)},
        {"cuts", name_of(record.forecast.cuts)},
        {"regions_a_node", record.forecast.regions_a_node}}},
      {"system", record.system ? Json(name_of(*record.system)) : Json()},
      {"homes", svm::name_of(record.forecast.homes)},
      {"computers", computers_json(record.forecast)},
      {"seconds", {{"load", record.load_seconds}, {"build", record.build_seconds}, {"regions", record.forecast.region_seconds}}}};
  return all.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";  // file names may not be valid UTF-8
}

}  // namespace dmpc::apps
