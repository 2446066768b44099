// The kinds of work of a program's nodes, in the program's terms.
#pragma once

#include <string>
#include <vector>

#include "apps/computer/vocabulary.h"
#include "nodes/observers/activity_profile.h"

namespace dmpc::apps {

/// Kinds of work; a span has one of them.
struct ProgramWork {
  std::vector<std::string> names;  ///< by number
  nodes::WorkOf work_of;
};

/// With packets: the first four operations (each where a call charged it and none before it), the other work of calls, and
/// messages. With tasks: the first three operations, other work, installing and serving pages, and messages.
ProgramWork program_work(const Vocabulary& vocabulary);

}  // namespace dmpc::apps
