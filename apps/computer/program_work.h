// What the nodes of a program are busy with, in its own words.
#pragma once

#include <string>
#include <vector>

#include "apps/computer/vocabulary.h"
#include "nodes/observers/activity_profile.h"

namespace dmpc::apps {

/// Kinds of work, of which a span is one.
struct ProgramWork {
  std::vector<std::string> names;  ///< by number
  nodes::WorkOf work_of;
};

/// A program with packets has its first four operations, each where a call was charged it and none before it, what else its calls
/// do, and messages. One of tasks has its first three, the rest, pages that are installed and served, and messages.
ProgramWork program_work(const Vocabulary& vocabulary);

}  // namespace dmpc::apps
