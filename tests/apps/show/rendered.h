// Small renders for tests, and what is said about them.
#pragma once

#include <optional>
#include <sstream>
#include <stop_token>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "apps/frontend/machine/machines.h"
#include "apps/run/run_strategy.h"
#include "apps/scene/load_scene.h"
#include "apps/scene/subject.h"
#include "apps/show/stats/stats.h"
#include "tests/support/text.h"

namespace dmpc::apps {

using tests::contains;

/// One small render and what is said about it.
struct Rendered {
  explicit Rendered(RenderOptions given, std::stop_token stop = {}) : options(std::move(given)) {
    Subject subject = build_subject(load_scene(options.picture), options.picture, options.database);
    database = std::move(subject.database);
    if (!options.heat_maps.empty()) {
      const core::Camera& camera = subject.settings.camera;
      heat.emplace(static_cast<std::uint32_t>(camera.width() * camera.height()), kinds_of(options.heat_maps));
    }
    const ReadyRun run = make_ready(options, database, subject.settings, {}, {.heat = heat ? &*heat : nullptr});
    notes = run.notes;
    report = run.start({}, std::move(stop));
  }
  RenderRecord record() const {
    return {options, database, *report, {.load = 0.5, .prepare = 0.25, .render = 2, .user = 1}, heat ? &*heat : nullptr};
  }
  std::string json() const { return stats_json(record()); }

  RenderOptions options;
  core::Database database;
  std::vector<std::string> notes;
  std::optional<Report> report;
  std::optional<nodes::HeatMap> heat;  ///< if options.heat_maps ask for one
};

inline RenderOptions small(Strategy strategy = Strategy::svm) {
  RenderOptions options;
  options.picture.scene = "balls-1";
  options.picture.resolution = {16, 12};
  options.strategy = strategy;
  options.database = usual_database(strategy);
  options.computer.node_count = 3;
  return options;
}

inline RenderOptions on_machine(RenderOptions options, const nodes::Machine& machine) {
  choose_machine(options, machine);
  return options;
}

/// The small one on a modelled machine.
inline RenderOptions modelled(Strategy strategy = Strategy::svm, std::string_view machine = "ipsc2") {
  return on_machine(small(strategy), find_machine_preset(machine)->machine);
}

/// What stands behind the first `"key": `, up to the line's end.
inline std::string value(const std::string& json, const std::string& key) {
  const std::size_t at = json.find("\"" + key + "\": ");
  const std::size_t begin = at + key.size() + 4;
  return at == std::string::npos ? "missing" : json.substr(begin, json.find_first_of(",\n", begin) - begin);
}

/// Keys that stand `depth` levels deep, in order.
inline std::vector<std::string> keys(const std::string& json, std::size_t depth) {
  std::vector<std::string> found;
  std::istringstream lines(json);
  for (std::string line; std::getline(lines, line);) {
    if (line.size() > 2 * depth && line.find_first_not_of(' ') == 2 * depth && line[2 * depth] == '"') {
      found.push_back(line.substr(2 * depth + 1, line.find('"', 2 * depth + 1) - 2 * depth - 1));
    }
  }
  return found;
}

}  // namespace dmpc::apps
