#include "apps/lab/bench/speed/plain_table.h"

#include <algorithm>
#include <map>

#include "apps/edge/line/number_text.h"
#include "apps/edge/table/averages.h"

namespace dmpc::apps {
namespace {

bool is_plain(const Comparison& comparison, const std::string& what) {
  return comparison.part == SpeedPart::plain && comparison.rounds() > 0 && comparison.what == what;
}

/// Rays that the plain renderer shoots, by scene.
std::map<std::string, double> rays_of(std::span<const Comparison> comparisons) {
  std::map<std::string, double> rays;
  for (const Comparison& comparison : comparisons) {
    if (is_plain(comparison, "rays")) {
      rays[comparison.scene] = comparison.rival_figures.front();
    }
  }
  return rays;
}

/// One renderer by one clock, a figure for each scene.
struct ByClock {
  std::vector<double> seconds, seconds_a_ray, ratios;

  void add(const Comparison& comparison, double rays) {
    const auto rounds = static_cast<std::ptrdiff_t>(comparison.rounds());
    seconds.push_back(median({comparison.subject_figures.begin(), comparison.subject_figures.begin() + rounds}));
    seconds_a_ray.push_back(seconds.back() / rays);
    ratios.push_back(ratio_of(comparison).median);
  }
};

/// One renderer.
struct Line {
  std::string subject;
  ByClock wall = {}, processor = {};
  std::vector<double> command_ratios = {};  ///< of whole commands, by processor time
};

std::vector<Line> lines_of(std::span<const Comparison> comparisons) {
  const std::map<std::string, double> rays = rays_of(comparisons);
  std::vector<Line> lines;
  for (const Comparison& comparison : comparisons) {
    const auto shot = rays.find(comparison.scene);
    if (!is_plain(comparison, "render") || shot == rays.end()) {
      continue;
    }
    auto found = std::find_if(lines.begin(), lines.end(), [&](const Line& line) { return line.subject == comparison.subject; });
    found = found == lines.end() ? lines.insert(found, {comparison.subject}) : found;
    (comparison.is_by_wall_clock() ? found->wall : found->processor).add(comparison, shot->second);
  }
  for (const Comparison& comparison : comparisons) {
    const auto is_same = [&](const Line& line) { return line.subject == comparison.subject; };
    const auto found = std::find_if(lines.begin(), lines.end(), is_same);
    if (is_plain(comparison, "command") && !comparison.is_by_wall_clock() && found != lines.end()) {
      found->command_ratios.push_back(ratio_of(comparison).median);
    }
  }
  return lines;
}

double mean(const std::vector<double>& figures, double scale = 1) { return scale * geometric_mean(figures).value_or(0); }

/// "1.02 (0.99 to 1.05)".
std::string spread_of(const std::vector<double>& ratios) {
  const auto [least, most] = std::minmax_element(ratios.begin(), ratios.end());
  return fixed(mean(ratios), 3) + " (" + fixed(*least, 3) + " to " + fixed(*most, 3) + ")";
}

/// The ratios of the comparisons of `what`.
std::vector<double> ratios_of(std::span<const Comparison> comparisons, const std::string& what) {
  return ratios_of(measured(comparisons, [&](const Comparison& one) { return is_plain(one, what); }));
}

}  // namespace

Table plain_table(std::span<const Comparison> comparisons, const std::string& title) {
  Table table(title, {{"renderer"},
                      {"picture", "ms", 1},
                      {"ray", "ns", 1},
                      {"over plain", "", 2},
                      {"least", "", 2},
                      {"most", "", 2},
                      {"picture, processor", "ms", 1},
                      {"ray, processor", "ns", 1},
                      {"over plain, processor", "", 2},
                      {"command over plain, processor", "", 2}});
  for (const Line& line : lines_of(comparisons)) {
    const auto [least, most] = std::minmax_element(line.wall.ratios.begin(), line.wall.ratios.end());
    table.add_row({line.subject, mean(line.wall.seconds, 1e3), mean(line.wall.seconds_a_ray, 1e9), mean(line.wall.ratios), *least,
                   *most, mean(line.processor.seconds, 1e3), mean(line.processor.seconds_a_ray, 1e9), mean(line.processor.ratios),
                   line.command_ratios.empty() ? Cell() : Cell(mean(line.command_ratios))});
  }
  return table;
}

std::vector<std::string> plain_notes(std::span<const Comparison> comparisons) {
  const std::vector<double> rays = ratios_of(comparisons, "rays");
  if (rays.empty()) {
    return {};
  }
  const std::vector<double> pov = ratios_of(comparisons, "POV-Ray's distance");
  return {"plain: our rays over the plain renderer's " + spread_of(rays) + "; its pictures lie " +
              spread_of(ratios_of(comparisons, "distance")) +
              " of 1/255 from ours (root mean square, linear), those of packets " +
              spread_of(ratios_of(comparisons, "packets' distance")) +
              "; building our database over building its tree, on all cores, by both clocks: " +
              spread_of(ratios_of(comparisons, "build")) + ".",
          pov.empty() ? "plain: POV-Ray has no row: it is not installed (povray), or was left out for --quick."
                      : "plain: POV-Ray's pictures lie " + spread_of(pov) +
                            " of 1/255 from ours; its times are what it says that tracing took."};
}

}  // namespace dmpc::apps
