// What the end of a `dmpc render` means that a study ran as a process of its own.
#pragma once

#include <optional>
#include <string>

#include "apps/edge/system/watched_process.h"

namespace dmpc::apps {

/// "dmpc: there is no room\n" as "there is no room".
std::string sentence_of(std::string complaint);

/// Nothing if it did what it should; why there was no room for it, if that was so. A computer out of memory ends a process by the
/// signal that cannot be caught. Throws core::InputError for bad input, core::InternalError for any other end.
std::optional<std::string> misfit_of(const WatchedProcess& process);

}  // namespace dmpc::apps
