// The file that a stability run is gone on with.
#pragma once

#include <filesystem>
#include <string>

#include "apps/edge/system/files.h"
#include "apps/lab/bench/stability/run.h"

namespace dmpc::apps {

/// `state` as text: a line that says what the file is, one with `options` (which tests, how many rays, which seed), one with how
/// far the run is, and one of counts for each row and kernel that was tried, and for each case.
std::string text_of(const StabilityState& state, const std::string& options);

/// Writes it whole or not at all. Throws core::InputError if that fails.
void save_state(const std::filesystem::path& path, const StabilityState& state, const std::string& options,
                Files& files = real_files());

/// Reads it into `state`, whose rows are those of the run that is to go on. If there is no file, nothing changes. Throws
/// core::InputError if the file cannot be read, is none of ours, is cut short, or is the state of a run with other options.
void load_state(const std::filesystem::path& path, StabilityState& state, const std::string& options,
                Files& files = real_files());

}  // namespace dmpc::apps
