#include "apps/lab/study/scale/figures.h"

#include <nlohmann/json.hpp>

#include "apps/edge/table/averages.h"
#include "core/base/expect.h"

namespace dmpc::apps {
namespace {

using Json = nlohmann::json;

constexpr double bytes_per_megabyte = 1e6;

double number_at(const Json& json, const char* pointer) { return json.at(Json::json_pointer(pointer)).get<double>(); }

std::optional<double> number_if_any(const Json& json, const char* pointer) {
  const Json::json_pointer at(pointer);
  return json.contains(at) && json.at(at).is_number() ? std::optional(json.at(at).get<double>()) : std::nullopt;
}

std::optional<double> over(std::optional<double> number, double divisor) {
  return number && divisor > 0 ? std::optional(*number / divisor) : std::nullopt;
}

double local_memories(const Json& json) {
  double bytes = 0;
  for (const Json& node : json.at("nodes")) {
    bytes += number_at(node, "/memory/planned/total");
  }
  return bytes;
}

void read_times(const Json& json, ScaleFigures& figures) {
  figures[ScaleFigure::load] = number_at(json, "/seconds/load");
  figures[ScaleFigure::build] = number_at(json, "/seconds/build");
  figures[ScaleFigure::prepare] = number_at(json, "/seconds/prepare");
  figures[ScaleFigure::render] = number_at(json, "/seconds/render");
  figures[ScaleFigure::processor] = number_at(json, "/seconds/render_user") + number_at(json, "/seconds/render_system");
  double total = number_at(json, "/seconds/write");
  for (const ScaleFigure phase : {ScaleFigure::load, ScaleFigure::build, ScaleFigure::prepare, ScaleFigure::render}) {
    total += *figures[phase];
  }
  figures[ScaleFigure::total] = total;
}

void read_counts(const Json& json, ScaleFigures& figures) {
  const double rays = number_at(json, "/rays/total");
  figures[ScaleFigure::database] = number_at(json, "/database/bytes") / bytes_per_megabyte;
  figures[ScaleFigure::local_memory] = local_memories(json) / bytes_per_megabyte;
  figures[ScaleFigure::faults] = over(number_if_any(json, "/pages/faults"), rays);
  figures[ScaleFigure::packets] = over(number_at(json, "/packets/sent"), rays);
  figures[ScaleFigure::moves] = number_if_any(json, "/travel/messages_per_ray");
  figures[ScaleFigure::pages] = number_if_any(json, "/pages/distinct_per_pixel");
}

}  // namespace

const Column& column_of(ScaleFigure figure) {
  static const std::array<Column, scale_figure_count> columns = {{{"load", "s", 3},
                                                                  {"build", "s", 3},
                                                                  {"prepare", "s", 3},
                                                                  {"render", "s", 3},
                                                                  {"total", "s", 3},
                                                                  {"processor", "s", 3},
                                                                  {"database", "MB", 2},
                                                                  {"memory", "MB", 2},
                                                                  {"local memory", "MB", 2},
                                                                  {"faults a ray", "", 4},
                                                                  {"packets a ray", "", 4},
                                                                  {"moves a ray", "", 3},
                                                                  {"pages a pixel", "", 2}}};
  return columns[static_cast<std::size_t>(figure)];
}

std::vector<ScaleFigure> all_scale_figures() {
  std::vector<ScaleFigure> figures;
  for (std::size_t number = 0; number < scale_figure_count; ++number) {
    figures.push_back(ScaleFigure{static_cast<std::uint8_t>(number)});
  }
  return figures;
}

ScaleFigures scale_figures_of(const std::string& stats, std::optional<std::size_t> memory_bytes) {
  try {
    const Json json = Json::parse(stats);
    ScaleFigures figures;
    read_times(json, figures);
    read_counts(json, figures);
    if (memory_bytes) {
      figures[ScaleFigure::memory] = static_cast<double>(*memory_bytes) / bytes_per_megabyte;
    }
    figures.primitives = json.at("database").at("primitives").get<std::uint64_t>();
    figures.film_hash = json.at("film_hash").get<std::string>();
    return figures;
  } catch (const Json::exception& error) {
    throw core::InternalError(std::string("the statistics of a render cannot be read: ") + error.what());
  }
}

ScaleFigures median_figures(const std::vector<ScaleFigures>& rounds) {
  ScaleFigures middle = rounds.at(0);
  for (const ScaleFigures& round : rounds) {
    core::expect(round.film_hash == middle.film_hash, "every run of a scene gives the same film");
  }
  for (const ScaleFigure figure : all_scale_figures()) {
    std::vector<double> numbers;
    for (const ScaleFigures& round : rounds) {
      if (round[figure]) {
        numbers.push_back(*round[figure]);
      }
    }
    middle[figure] = numbers.empty() ? std::nullopt : std::optional(median(std::move(numbers)));
  }
  return middle;
}

}  // namespace dmpc::apps
