// The process of a user's policy: how it is started, and what is said of its end.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "apps/frontend/system/child_process.h"
#include "core/base/expect.h"

namespace dmpc::apps {

/// How long a policy may take for a call.
struct PolicyPatience {
  std::uint32_t call_seconds = 30;     ///< of processor time, after which it does not come back
  std::uint32_t answer_seconds = 600;  ///< of time, after which its process does not answer a run
};

/// What of a policy its process needs: it is named by the option that it was given with.
struct PolicyPlace {
  std::string option, text;      ///< "--policy", "python:/home/me/clock.py:Clock"
  std::string path, class_name;  ///< no class for a shared library
  std::string source;            ///< of a class
  PolicyPatience patience;
};

/// The most that a process may print.
inline constexpr std::size_t policy_says_bytes_max = std::size_t{1} << 20U;

/// The process reads from `input` and answers to `output`, which are open files. Throws as ChildProcess does.
ChildSettings process_settings(const PolicyPlace& place, int input, int output);
/// Returns the last message of a process that has ended, or how it did.
std::string complaint_of(const ChildProcess& process, int status);
/// Throws core::InputError if it has printed more than it may.
void check_says_little(const ChildProcess& process);

/// Calls `made`; an error of the policy gets its option and place in front.
template <class Do>
auto reported_of(const PolicyPlace& place, const Do& made) {
  try {
    return made();
  } catch (const core::InputError& error) {
    throw core::InputError(place.option + "=" + place.text + ": " + error.what());
  }
}

}  // namespace dmpc::apps
