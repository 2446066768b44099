// The command line as one struct a command.
#pragma once

#include <span>
#include <string>
#include <variant>

#include "apps/bench/error/command.h"
#include "apps/bench/precision/command.h"
#include "apps/bench/speed/command.h"
#include "apps/bench/stability/command.h"
#include "apps/check/command.h"
#include "apps/help/list_command.h"
#include "apps/info/command.h"
#include "apps/line/command_line.h"
#include "apps/machine/machine_command.h"
#include "apps/picture/compare_command.h"
#include "apps/run/render_options.h"
#include "apps/scene/scene_command.h"
#include "apps/study/options.h"
#include "apps/study/paper/command.h"
#include "apps/study/scale/command.h"

namespace dmpc::apps {

using Command =
    std::variant<HelpText, RenderOptions, InfoOptions, SceneOptions, CheckOptions, CompareOptions, MachineOptions, StudyOptions,
                 PaperStudyOptions, ScaleOptions, StabilityOptions, PrecisionOptions, ErrorOptions, SpeedOptions, ListOptions>;

/// `arguments` without the program's name. Throws core::UsageError, whose message ends with a hint at the right --help, for
/// anything wrong that can be seen without reading a file.
Command parse_command_line(std::span<const std::string> arguments);

/// All commands with all options, as parse_command_line() takes them.
CommandDescription describe_command_line();

}  // namespace dmpc::apps
