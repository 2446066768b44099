// The command line as one struct a command.
#pragma once

#include <span>
#include <string>
#include <variant>

#include "apps/accurate/precision_command.h"
#include "apps/check.h"
#include "apps/command_line.h"
#include "apps/compare.h"
#include "apps/error/command.h"
#include "apps/info/command.h"
#include "apps/machine.h"
#include "apps/render_options.h"
#include "apps/scale/command.h"
#include "apps/scene.h"
#include "apps/speed/command.h"
#include "apps/stability/command.h"
#include "apps/study_options.h"
#include "apps/study_paper.h"
#include "apps/usage/list_command.h"

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
