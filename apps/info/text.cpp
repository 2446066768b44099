#include "apps/info/text.h"

#include <algorithm>

#include "apps/frontend/line/number_text.h"
#include "apps/frontend/line/shown_text.h"
#include "apps/frontend/table/table.h"
#include "apps/info/record.h"
#include "apps/run/many_nodes.h"
#include "apps/run/strategy_options.h"
#include "apps/scene/scene_setup.h"
#include "apps/scene/subject.h"
#include "nodes/size_text.h"

namespace dmpc::apps {

namespace {

constexpr std::size_t lights_shown_max = 8;

/// Returns "7,381 spheres, 1 polygon".
std::string objects_text(const SceneFigures& scene) {
  constexpr std::array<const char*, core::object_kind_count> names = {"polygon", "patch with normals", "textured patch", "sphere",
                                                                      "cone"};
  constexpr std::array<const char*, core::object_kind_count> plurals = {"polygons", "patches with normals", "textured patches",
                                                                        "spheres", "cones"};
  std::string text;
  for (std::size_t kind = 0; kind < core::object_kind_count; ++kind) {
    const std::uint64_t count = scene.objects[kind];
    text += count == 0 ? "" : (text.empty() ? "" : ", ") + grouped(count) + " " + (count == 1 ? names : plurals)[kind];
  }
  return text.empty() ? "no objects" : text;
}

std::string primitives_text(const DatabaseFigures& database) {
  const std::string dropped = dropped_text(database.dropped), duplicates = duplicates_text(database.duplicates);
  return grouped(database.primitives) + (dropped.empty() ? "" : "; " + dropped + ": no area or length, radius 0, or not finite") +
         (duplicates.empty() ? "" : "; " + duplicates);
}

/// Empty if rounding has no effect.
std::string rounding_line(const core::RoundingLoss& loss) {
  const std::string text = loss_text(loss);
  return text.empty() ? "" : "\nrounding   " + text;
}

std::string triple(const core::Vec3d& vector, const std::string& mark) {
  return rounded(vector.x) + mark + rounded(vector.y) + mark + rounded(vector.z);
}

std::string bounds_text(const core::Box& bounds) {
  return bounds.empty() ? "the scene is empty"
                        : triple(bounds.low, ",") + " to " + triple(bounds.high, ",") + ", extent " +
                              triple(bounds.high - bounds.low, " x ");
}

std::string view_text(const InfoRecord& record) {
  return "--camera=" + text_of(camera_of(record.scene.view)) + ", " + std::to_string(record.width) + "x" +
         std::to_string(record.height) + " pixels";
}

std::string lights_text(const SceneFigures& scene) {
  std::string text = std::to_string(scene.lights.size());
  for (std::size_t i = 0; i < std::min(lights_shown_max, scene.lights.size()); ++i) {
    text +=
        (i == 0 ? ": " : " ") + std::string(scene.lights[i].is_plain() ? "--light=" : "falling off ") + text_of(scene.lights[i]);
  }
  return text + (scene.lights.size() > lights_shown_max ? " ..." : "");
}

std::string materials_text(const MaterialCounts& materials) {
  return grouped(materials.count) + ", of which mirror " + grouped(materials.mirroring) + ", transmit " +
         grouped(materials.transmitting) + ", are textured " + grouped(materials.textured);
}

std::string database_text(const DatabaseFigures& database) {
  return bytes_text(database.bytes) + ": " + counted(database.pages, "page") + " of " +
         nodes::size_text(database.page_size_bytes) + "; " + fixed(database.bytes_each(), 1) + " bytes a primitive, " +
         fixed(database.copies_each(), 2) + " copies of each";
}

/// Empty if no mesh has several instances.
std::string meshes_line(const InfoRecord& record) {
  const MeshFigures& meshes = record.scene.meshes;
  if (meshes.places == 0) {
    return "";
  }
  const bool are_instanced = record.database.instances > 0;
  return "\nmeshes     " + grouped(meshes.count) + " in " + counted(meshes.places, "place") + ": " +
         counted(meshes.triangles, "triangle") + " for " + grouped(meshes.triangles_in_places) +
         (are_instanced ? "; kept once in " + counted(record.database.instances, "place") + ", with a copy in each place about "
          : meshes.stored_share >= 1 ? "; a copy in each place, kept once no less than "
                                     : "; a copy in each place, kept once (--instances=keep) about ") +
         bytes_text(record.database.bytes_otherwise(meshes.stored_share)) + " of database";
}

std::string sizes_text(const std::array<std::int32_t, 3>& sizes) {
  return std::to_string(sizes[0]) + "x" + std::to_string(sizes[1]) + "x" + std::to_string(sizes[2]);
}

std::string grid_text(const DatabaseFigures& database) {
  if (database.has_voxels && database.occupied_macro_cells == 0) {
    return sizes_text(database.macro_cells) + " voxels, none of them with a list";
  }
  if (database.has_voxels) {
    const double each = static_cast<double>(database.references) / static_cast<double>(database.occupied_macro_cells);
    return sizes_text(database.macro_cells) + " voxels, " + grouped(database.occupied_macro_cells) + " of them with lists, of " +
           fixed(each, 2) + " leaves in the mean; " + fixed(database.primitives_a_leaf(), 2) + " primitives a leaf";
  }
  return sizes_text(database.cells) + " cells, " + sizes_text(database.macro_cells) + " macro cells, " +
         grouped(database.occupied_macro_cells) + " of them occupied; trees of up to " + counted(database.levels_max, "level") +
         ", " + fixed(database.primitives_a_leaf(), 2) + " primitives a leaf";
}

std::string process_text(const InfoRecord& record) {
  return bytes_text(record.build_peak_bytes) +
         " used until the database was built; a render uses more than this, and more than its nodes take";
}

/// Includes the computers on which a render would be refused.
std::string room_text(const InfoRecord& record) {
  std::string too_large;
  for (const ComputerForecast& computer : record.forecast.computers) {
    using Choice = std::pair<const char*, std::optional<MemoryForecast>>;
    for (const auto& [name, memory] : {Choice("svm", computer.svm), Choice("dataflow", computer.dataflow),
                                       Choice("forest", computer.forest), Choice("replicated", computer.replicated)}) {
      if (memory && memory->all_bytes > record.room.bytes) {
        too_large +=
            (too_large.empty() ? "; too little for " : ", ") + std::string(name) + " on " + std::to_string(computer.nodes);
      }
    }
  }
  return bytes_text(record.room.bytes) + ", " + record.room.source + too_large;
}

std::string time_text(const InfoRecord& record) {
  return "load " + seconds_text(record.load_seconds) + ", build " + seconds_text(record.build_seconds) + ", regions " +
         seconds_text(record.forecast.region_seconds);
}

/// Empty if no system is requested.
std::string system_line(const InfoRecord& record) {
  if (!record.system) {
    return "";
  }
  return "\nsystem     " + std::string(name_of(*record.system)) + ": " + options_of(*record.system);
}

Table records_table(const DatabaseFigures& database) {
  Table table("Records", {{"kind"}, {"count"}, {"bytes"}, {"share", "%", 1}});
  const auto add = [&](const std::string& kind, const Cell& count, std::uint64_t bytes) {
    table.add_row({kind, count, bytes, 100 * static_cast<double>(bytes) / static_cast<double>(database.bytes)});
  };
  for (const RecordFigures& record : database.records) {
    if (record.count > 0) {
      add(record.kind, record.count, record.bytes);
    }
  }
  add("unused, between records", {}, database.unused_bytes);
  return table;
}

Table textures_table(const SceneFigures& scene) {
  Table table("Textures", {{"name"}, {"texels"}, {"levels"}, {"format"}, {"tiles"}, {"bytes of tiles"}, {"bytes of table"}});
  for (const TextureFigures& texture : scene.textures) {
    const std::string texels = std::to_string(texture.width) + "x" + std::to_string(texture.height);
    table.add_row({texture.name, texels, std::uint64_t{texture.levels}, name_of(texture.format), texture.tiles,
                   texture.tile_bytes, texture.table_bytes});
  }
  return table;
}

/// Adds the minimum memory of a node, and the default total; nothing for an impossible computer.
void add_cells(std::vector<Cell>& row, const std::optional<MemoryForecast>& memory) {
  if (!memory) {
    row.resize(row.size() + 2);
    return;
  }
  row.emplace_back(std::uint64_t{memory->least_bytes});
  row.emplace_back(bytes_text(memory->all_bytes));
}

Table memory_table(const Forecast& forecast) {
  const bool has_forest = !forecast.computers.empty() && forecast.computers.front().forest.has_value();
  std::vector<Column> columns = {
      {"nodes"},  {"svm, least", "bytes"},        {"svm, all"},       {"dataflow, least", "bytes"}, {"dataflow, all"},
      {"copies"}, {"replicated, least", "bytes"}, {"replicated, all"}};
  if (has_forest) {
    columns.insert(columns.end(), {{"forest, least", "bytes"}, {"forest, all"}});
  }
  Table table("Memory", columns);
  table.add_note(
      "least: of a node; with less --node-memory all nodes together are too small for the scene, and render refuses it");
  table.add_note("all: of all nodes and the host together, if no option sets their memory");
  table.add_note(
      "both with the default options of a render on threads: larger caches, batches and queues, chaos, counted pages and "
      "--resume take more");
  table.add_note("with --runner=pool the same counts, but pages lie in the host's database, which stays; dataflow has copies");
  if (!forecast.computers.empty() && forecast.computers.back().nodes >= many_nodes_min) {
    table.add_note("svm, " + std::to_string(many_nodes_min) + " nodes or more on few processors: render takes less time with " +
                   many_nodes_options);
  }
  table.add_note(
      "copies: of a primitive with dataflow, whose regions are made by --balance=" + std::string(name_of(forecast.balance)) +
      (forecast.cuts == dataflow::CutOrder::longer_axis ? "" : " --cuts=" + std::string(name_of(forecast.cuts))) +
      (forecast.regions_a_node > 1 ? " --regions=" + std::to_string(forecast.regions_a_node) : "") +
      (forecast.balance == dataflow::Balance::equal_size
           ? "; those that render chooses may need several times as much: --balance=subsampled shows it"
           : ""));
  if (are_at_host(forecast.homes)) {
    table.add_note("svm: with --homes=" + std::string(name_of(forecast.homes)) +
                   ": the host has the pages, and \"all\" includes its memory");
  }
  for (const ComputerForecast& computer : forecast.computers) {
    std::vector<Cell> row = {std::uint64_t{computer.nodes}};
    add_cells(row, computer.svm);
    add_cells(row, computer.dataflow);
    row.emplace_back(computer.dataflow ? fixed(computer.dataflow_copies, 2) : "");
    add_cells(row, computer.replicated);
    if (has_forest) {
      add_cells(row, computer.forest);
    }
    table.add_row(row);
  }
  return table;
}

}  // namespace

std::string info_text(const InfoRecord& record) {
  const SceneFigures& scene = record.scene;
  const std::string lines = "scene      " + scene.name + ": " + objects_text(scene) +  //
                            "\nprimitives " + primitives_text(record.database) +       //
                            rounding_line(record.loss) +                               //
                            "\nbounds     " + bounds_text(scene.bounds) +              //
                            "\nview       " + view_text(record) +                      //
                            "\nlights     " + lights_text(scene) +                     //
                            "\nmaterials  " + materials_text(scene.materials) +        //
                            "\ntextures   " + std::to_string(scene.textures.size()) +  //
                            meshes_line(record) +                                      //
                            "\ndatabase   " + database_text(record.database) +         //
                            "\ngrid       " + grid_text(record.database) +             //
                            system_line(record) +                                      //
                            "\nprocess    " + process_text(record) +                   //
                            "\nroom       " + room_text(record) +                      //
                            "\ntime       " + time_text(record) + "\n\n" +             //
                            text_of(records_table(record.database), TableFormat::markdown) + "\n";
  const std::string textures = scene.textures.empty() ? "" : text_of(textures_table(scene), TableFormat::markdown) + "\n";
  return shown(lines + textures + text_of(memory_table(record.forecast), TableFormat::markdown));
}

}  // namespace dmpc::apps
