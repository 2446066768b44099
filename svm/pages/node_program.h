// What every node program of this family reports when the run is over.
#pragma once

#include <cstdint>

#include "core/trace/operations.h"
#include "nodes/program.h"

namespace dmpc::svm {

/// References are look-ups of a page, counted once, when they are first answered: retrying a step after its page has arrived is
/// not a second reference.
struct PageCounters {
  std::uint64_t references = 0;      ///< home_hits + cache_hits + misses
  std::uint64_t home_hits = 0;       ///< the page is stored here permanently: at home, or resident at every node
  std::uint64_t cache_hits = 0;      ///< page hits in the cache
  std::uint64_t misses = 0;          ///< page misses: ten rays missing one page make ten
  std::uint64_t faults = 0;          ///< page misses that started a request: ten rays missing one page make one
  std::uint64_t evictions = 0;       ///< pages that were replaced in their frame
  std::uint64_t served = 0;          ///< replies to other nodes' requests
  std::uint64_t distinct_pages = 0;  ///< distinct pages that a pixel referenced, summed over pixels; 0 unless requested
};

struct WorkCounters {
  std::uint64_t pixels_rendered = 0;
  std::uint64_t items_asked = 0;  ///< work requests sent
  std::uint64_t items_taken = 0;  ///< items received from other nodes
  std::uint64_t items_given = 0;  ///< items given to other nodes
};

/// Questions of nodes with strategy forest, and their answers.
struct QuestionCounters {
  std::uint64_t rays_asked = 0;        ///< questions what a ray hits below a child
  std::uint64_t records_asked = 0;     ///< questions for a record, for shading, or for a traversal that leads into base meshes
  std::uint64_t rays_answered = 0;     ///< for other nodes
  std::uint64_t records_answered = 0;  ///< for other nodes
  std::uint64_t answers = 0;           ///< answers received, to either kind
};

/// All that a program counted.
struct ProgramReport {
  core::Operations operations;
  PageCounters pages;
  WorkCounters work;
  QuestionCounters questions = {};
  std::uint64_t rays_ended = 0;  ///< hits or misses; at the end of a run as many as were shot
};

/// A node program that reports. Call report() only while the program is not running.
class NodeProgram : public nodes::Program {
 public:
  virtual ProgramReport report() const = 0;
};

}  // namespace dmpc::svm
