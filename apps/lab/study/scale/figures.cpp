#include "apps/lab/study/scale/figures.h"

#include "apps/edge/table/averages.h"
#include "apps/edge/table/filled_columns.h"
#include "apps/lab/study/engine/render_process.h"
#include "core/base/elementary.h"
#include "core/base/expect.h"

namespace dmpc::apps {
namespace {

constexpr double bytes_per_megabyte = 1e6;

/// What a run tells.
struct ScaleStats {
  const std::vector<Figure>& stats;
  std::optional<std::size_t> memory_bytes;

  double operator[](const char* name) const { return needed_number(stats, name); }
  std::optional<double> if_any(const char* name) const { return number_of(stats, name); }
  std::optional<double> a_ray(std::optional<double> number) const {
    const double rays = (*this)["rays.total"];
    return number && rays > 0 ? std::optional(*number / rays) : std::nullopt;
  }
  double local_memory_bytes() const {
    double bytes = 0;
    for (const Figure& figure : stats) {
      bytes += is_within(figure.name, "nodes.*.memory.planned.total") ? number_of(figure.value).value_or(0) : 0;
    }
    return bytes;
  }
};

double total_seconds(const ScaleStats& told) {
  return told["seconds.write"] + told["seconds.load"] + told["seconds.build"] + told["seconds.prepare"] + told["seconds.render"];
}

/// By number.
const std::array<FilledColumn<ScaleStats>, scale_figure_count>& scale_figure_columns() {
  const auto megabytes = [](double bytes) { return bytes / bytes_per_megabyte; };
  static const std::array<FilledColumn<ScaleStats>, scale_figure_count> columns = {
      {{{"load", "s", 3}, [](const ScaleStats& told) { return told["seconds.load"]; }},
       {{"build", "s", 3}, [](const ScaleStats& told) { return told["seconds.build"]; }},
       {{"prepare", "s", 3}, [](const ScaleStats& told) { return told["seconds.prepare"]; }},
       {{"render", "s", 3}, [](const ScaleStats& told) { return told["seconds.render"]; }},
       {{"total", "s", 3}, total_seconds},
       {{"processor", "s", 3},
        [](const ScaleStats& told) { return told["seconds.render_user"] + told["seconds.render_system"]; }},
       {{"database", "MB", 2}, [=](const ScaleStats& told) { return megabytes(told["database.bytes"]); }},
       {{"memory", "MB", 2},
        only_if([](const ScaleStats& told) { return told.memory_bytes.has_value(); },
                [=](const ScaleStats& told) { return megabytes(static_cast<double>(*told.memory_bytes)); })},
       {{"local memory", "MB", 2}, [=](const ScaleStats& told) { return megabytes(told.local_memory_bytes()); }},
       {{"faults a ray", "", 4}, [](const ScaleStats& told) { return cell_of(told.a_ray(told.if_any("pages.faults"))); }},
       {{"packets a ray", "", 4}, [](const ScaleStats& told) { return cell_of(told.a_ray(told["packets.sent"])); }},
       {{"moves a ray", "", 3}, [](const ScaleStats& told) { return cell_of(told.if_any("travel.messages_per_ray")); }},
       {{"pages a pixel", "", 2}, [](const ScaleStats& told) { return cell_of(told.if_any("pages.distinct_per_pixel")); }}}};
  return columns;
}

}  // namespace

const Column& column_of(ScaleFigure figure) { return scale_figure_columns()[static_cast<std::size_t>(figure)].column; }

std::vector<ScaleFigure> all_scale_figures() {
  std::vector<ScaleFigure> figures;
  for (std::size_t number = 0; number < scale_figure_count; ++number) {
    figures.push_back(ScaleFigure{static_cast<std::uint8_t>(number)});
  }
  return figures;
}

ScaleFigures scale_figures_of(const std::vector<Figure>& stats, std::optional<std::size_t> memory_bytes) {
  const ScaleStats told{stats, memory_bytes};
  ScaleFigures figures;
  for (const ScaleFigure figure : all_scale_figures()) {
    const Cell cell = scale_figure_columns()[static_cast<std::size_t>(figure)].cell(told);
    const double* const number = std::get_if<double>(&cell);
    figures[figure] = number != nullptr ? std::optional(*number) : std::nullopt;
  }
  figures.primitives = static_cast<std::uint64_t>(told["database.primitives"]);
  const FigureValue* const film = find_value(stats, "film_hash");
  core::expect(film != nullptr, "the statistics of a render have its film's hash");
  figures.film_hash = text_of(*film);
  return figures;
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

namespace {

using Points = std::vector<std::pair<double, double>>;

/// Measured from the first, so that what does not grow at all comes out as 0.
Points logarithms(std::span<const std::pair<double, double>> points) {
  Points logs;
  for (const auto& [x, y] : points) {
    if (x > 0 && y > 0) {
      logs.emplace_back(core::natural_log(x), core::natural_log(y));
    }
  }
  for (std::size_t i = logs.size(); i-- > 0;) {
    logs[i] = {logs[i].first - logs[0].first, logs[i].second - logs[0].second};
  }
  return logs;
}

}  // namespace

std::optional<double> growth_exponent(std::span<const std::pair<double, double>> points) {
  const Points logs = logarithms(points);
  double x_sum = 0, y_sum = 0;
  for (const auto& [x, y] : logs) {
    x_sum += x;
    y_sum += y;
  }
  const double count = static_cast<double>(logs.size());
  double squares = 0, products = 0;
  for (const auto& [x, y] : logs) {
    const double from_middle = x - x_sum / count;
    squares += from_middle * from_middle;
    products += from_middle * (y - y_sum / count);
  }
  constexpr double same = 1e-12;  // what rounding leaves of equal x
  return squares > same ? std::optional(products / squares) : std::nullopt;
}

}  // namespace dmpc::apps
