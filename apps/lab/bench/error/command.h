// The command `bench error`: the cost of every knob of a render, and its effect on the picture's error. Here are its options and
// the references; the renders, and what they say, are a program in Python (apps/python/dmpc/errors).
#pragma once

#include <cstdint>
#include <iosfwd>
#include <string>
#include <vector>

#include "apps/frontend/line/command_line.h"
#include "apps/frontend/system/interrupt.h"
#include "apps/frontend/table/table_options.h"
#include "apps/lab/oracle/reference/reference.h"
#include "apps/run/strategy_options.h"
#include "apps/scene/picture_options.h"

namespace dmpc::apps {

struct ErrorOptions {
  ErrorOptions();  ///< 16 samples and depth 8, replicated on as many nodes as there are cores

  std::vector<std::string> scenes;
  std::vector<std::string> knobs;  ///< names
  PictureOptions picture;          ///< the base point, on which one knob at a time is turned; `scene` is not read
  StrategyOptions strategy;        ///< what renders, on threads
  ReferenceOptions reference;
  bool is_quick = false;
  std::uint32_t rounds = 3;
  TableOutput table;               ///< without a page
  bool quiet = false;              ///< no progress
  std::vector<std::string> words;  ///< once a line is read: what the program in Python is told, with chosen defaults
};

void add_options(OptionSet set, ErrorOptions& options);

/// Returns powers of 2 by which a built-in scene can be tessellated into different scenes of at most a million primitives; none
/// for scenes without spheres and cones, tessellated ones, and files.
std::vector<int> tessellations_of(const std::string& scene, bool is_quick);

/// Checks the outputs, computes the references of all scenes, and becomes Python: does not return. Throws core::UsageError for
/// outputs that clash, core::InputError for an unsuitable scene or outputs that cannot be made, Interrupted after a signal.
int bench_error_command(const ErrorOptions& options, Interrupt& interrupt, std::ostream& output);

}  // namespace dmpc::apps
