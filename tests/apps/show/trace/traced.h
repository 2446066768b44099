// Small renders with a trace, as files.
#pragma once

#include <cstdint>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "apps/frontend/machine/machines.h"
#include "apps/run/render_record.h"
#include "apps/run/run_strategy.h"
#include "apps/scene/load_scene.h"
#include "apps/scene/subject.h"
#include "apps/show/trace/file.h"
#include "nodes/observers/trace.h"

namespace dmpc::apps {

/// A render of 8x8 pixels on three nodes whose caches hold two pages.
inline RenderOptions to_trace(Strategy strategy, RunnerKind runner) {
  RenderOptions options;
  options.picture.scene = "balls-1";
  options.picture.resolution = {8, 8};
  options.database.build.page_size_bytes = 512;
  options.strategy = strategy;
  options.computer.node_count = 3;
  if (strategy == Strategy::svm) {
    options.pages.cache_pages = 2;
  }
  if (runner == RunnerKind::virtual_time) {
    choose_machine(options, find_machine_preset("ipsc2")->machine);
  }
  return options;
}

/// A render and its trace.
struct Traced {
  explicit Traced(RenderOptions given) : options(std::move(given)), report(render()) {}

  /// What is written to a file.
  std::string text() const {
    std::ostringstream stream;
    write_trace({.options = options, .database = database, .report = report, .seconds = {}, .trace = &trace}, stream);
    return stream.str();
  }

  RenderOptions options;
  core::Database database;
  nodes::Trace trace;
  Report report;

 private:
  Report render() {
    Subject subject = build_subject(load_scene(options.picture), options.picture, options.database);
    database = std::move(subject.database);
    const std::uint32_t node_count = options.computer.node_count;
    nodes::TraceRecorder recorder(node_count + 1, trace_choice(options.trace));
    Report made = make_ready(options, database, subject.settings, {}, {.observer = &recorder}).start({}, {});
    trace = recorder.take();
    return made;
  }
};

}  // namespace dmpc::apps
