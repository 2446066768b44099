// What the program ends with; 0 is for a job done.
#pragma once

namespace dmpc::apps {

/// Bad input, wrong usage, an error of dmpc's own, no room on this computer or in the nodes' memory, and a signal.
inline constexpr int input_status = 1, usage_status = 2, internal_status = 3, no_room_status = 4, interrupted_status = 130;

}  // namespace dmpc::apps
