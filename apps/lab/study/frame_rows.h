// Table rows on the cost of frames of a moving camera, for nodes that keep their contents between frames and for nodes that begin
// anew with each frame.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "apps/frontend/table/filled_columns.h"
#include "apps/run/report.h"
#include "apps/run/strategy_options.h"

namespace dmpc::apps {

struct FrameFigures {
  std::uint64_t film = 0;             ///< its hash
  std::uint64_t faults = 0;           ///< page faults, of all nodes
  std::uint64_t node_faults_max = 0;  ///< of the node with the most
  std::uint64_t messages = 0;         ///< packets of every kind
  std::uint64_t bytes = 0;            ///< of pages, of packets with questions and answers, or of packets with rays
  std::uint64_t total_ns = 0;         ///< virtual time
};

/// Returns the figures of a finished run on a modelled machine.
FrameFigures figures_of(const Report& report);

/// The kind of data that travels, and the caches.
struct FramesCase {
  std::string what;
  Strategy strategy = Strategy::svm;
  std::uint32_t cache_pages = 0;  ///< of svm

  bool has_pages() const { return strategy == Strategy::svm; }
};

struct FrameSeries {
  std::string machine;
  std::uint32_t node_count = 1;
  FramesCase of;
  std::uint32_t page_count = 1;          ///< of the database
  std::vector<FrameFigures> warm, cold;  ///< equally many; the first is the same in both
};

/// Frames of a series, by their indices in it.
struct FramesRow {
  const FrameSeries& series;
  std::size_t begin = 0, end = 1;
  std::string frames;  ///< their names, counted from 1: "3", or "2 to 6" of means
};

/// Columns for FramesRow; figures are means over its frames.
const FilledColumns<FramesRow>& frames_columns();

}  // namespace dmpc::apps
