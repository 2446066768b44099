#include "apps/lab/study/scale/figures.h"

#include "apps/frontend/table/averages.h"
#include "core/base/elementary.h"
#include "core/base/expect.h"
#include "core/base/ranges.h"

namespace dmpc::apps {
namespace {

constexpr double bytes_per_megabyte = 1e6;

double local_memory_bytes(const std::vector<Figure>& stats) {
  return core::sum_over<double>(stats, [&](const Figure& figure) {
    return is_within(figure.name, "nodes.*.memory.planned.total") ? number_of(figure.value).value_or(0) : 0;
  });
}

}  // namespace

const std::vector<Column>& scale_figure_columns() {
  static const std::vector<Column> columns = {{"load", "s", 3},        {"build", "s", 3},        {"prepare", "s", 3},
                                              {"render", "s", 3},      {"total", "s", 3},        {"processor", "s", 3},
                                              {"database", "MB", 2},   {"memory", "MB", 2},      {"local memory", "MB", 2},
                                              {"faults a ray", "", 4}, {"packets a ray", "", 4}, {"moves a ray", "", 3},
                                              {"pages a pixel", "", 2}};
  return columns;
}

ScaleFigures scale_figures_of(const std::vector<Figure>& stats, std::optional<std::size_t> memory_bytes) {
  const auto needed = [&](const std::string& name) { return needed_number(stats, name); };
  const double rays = needed("rays.total");
  const FigureValue* const film = find_value(stats, "film_hash");
  core::expect(film != nullptr, "the statistics of a render have its film's hash");
  ScaleFigures figures{.by_name = {{"processor", needed("seconds.render_user") + needed("seconds.render_system")},
                                   {"database", needed("database.bytes") / bytes_per_megabyte},
                                   {"local memory", local_memory_bytes(stats) / bytes_per_megabyte}},
                       .primitives = static_cast<std::uint64_t>(needed("database.primitives")),
                       .film_hash = text_of(*film)};
  double& total = figures.by_name["total"] = needed("seconds.write");
  for (const char* const phase : {"load", "build", "prepare", "render"}) {
    total += figures.by_name[phase] = needed(std::string("seconds.") + phase);
  }
  const auto add = [&](const char* name, std::optional<double> number, double over) {
    if (number && over > 0) {
      figures.by_name[name] = *number / over;
    }
  };
  add("memory", memory_bytes ? std::optional(static_cast<double>(*memory_bytes)) : std::nullopt, bytes_per_megabyte);
  add("faults a ray", number_of(stats, "pages.faults"), rays);
  add("packets a ray", needed("packets.sent"), rays);
  add("moves a ray", number_of(stats, "travel.messages_per_ray"), 1);
  add("pages a pixel", number_of(stats, "pages.distinct_per_pixel"), 1);
  return figures;
}

ScaleFigures median_figures(const std::vector<ScaleFigures>& rounds) {
  ScaleFigures middle = rounds.at(0);
  std::map<std::string, std::vector<double>> numbers;
  for (const ScaleFigures& round : rounds) {
    core::expect(round.film_hash == middle.film_hash, "every run of a scene gives the same film");
    for (const auto& [name, number] : round.by_name) {
      numbers[name].push_back(number);
    }
  }
  for (auto& [name, all] : numbers) {
    middle.by_name[name] = median(std::move(all));
  }
  return middle;
}

std::optional<double> growth_exponent(std::span<const std::pair<double, double>> points) {
  std::vector<std::pair<double, double>> logs;
  double x_sum = 0, y_sum = 0;
  for (const auto& [x, y] : points) {
    if (x > 0 && y > 0) {
      logs.emplace_back(core::natural_log(x), core::natural_log(y));
      // Relative to the first, so that an exponent of no growth is exactly 0.
      x_sum += logs.back().first - logs.front().first;
      y_sum += logs.back().second - logs.front().second;
    }
  }
  const double count = static_cast<double>(logs.size());
  double squares = 0, products = 0;
  for (const auto& [x, y] : logs) {
    const double from_middle = x - logs.front().first - x_sum / count;
    squares += from_middle * from_middle;
    products += from_middle * (y - logs.front().second - y_sum / count);
  }
  constexpr double same = 1e-12;  // rounding error of equal x
  return squares > same ? std::optional(products / squares) : std::nullopt;
}

}  // namespace dmpc::apps
