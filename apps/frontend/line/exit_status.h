// Exit statuses of the program.
#pragma once

namespace dmpc::apps {

/// Bad input, wrong usage, an internal error of dmpc, not enough memory on this computer or in the nodes, a difference where
/// equality was expected, and a signal.
inline constexpr int input_status = 1, usage_status = 2, internal_status = 3, no_capacity_status = 4, differs_status = 5,
                     interrupted_status = 130;

struct ExitStatus {
  int status;
  const char* meaning;
};

/// All of them.
inline constexpr ExitStatus exit_statuses[] = {
    {0, "The job is done."},
    {input_status, "Bad input, or an output that cannot be written: the message says what, where, and what to do."},
    {usage_status, "Wrong usage: the message ends with the right --help."},
    {internal_status,
     "An internal error of dmpc, a missing part of it, or a difference that check or bench precision cannot explain."},
    {no_capacity_status, "Not enough memory for the input, on this computer or on the nodes."},
    {differs_status, "compare found a difference: more than --fail-above allows, or in a counter."},
    {interrupted_status, "Interrupted by a signal: the message says what became of the output."},
};

}  // namespace dmpc::apps
