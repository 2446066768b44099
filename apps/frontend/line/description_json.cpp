#include "apps/frontend/line/description_json.h"

#include <nlohmann/json.hpp>

#include "apps/frontend/line/exit_status.h"
#include "core/base/ranges.h"

namespace dmpc::apps {
namespace {

using Json = nlohmann::ordered_json;

Json option_json(const OptionDescription& option) {
  const Suggestion& suggestion = option.suggestion;
  return {{"names", option.names},
          {"value", option.value},
          {"text", option.text},
          {"group", option.group},
          {"is_required", option.is_required},
          {"has_optional_value", option.has_optional_value},
          {"is_repeatable", option.is_repeatable},
          {"is_list", option.is_list},
          {"suggestion",
           {{"words", suggestion.words},
            {"files", suggestion.files},
            {"folders", suggestion.folders},
            {"endings", suggestion.endings}}}};
}

Json command_json(const CommandDescription& command) {
  return {{"name", command.name},
          {"text", command.text},
          {"examples", command.examples},
          {"arguments", core::mapped<Json>(command.arguments, option_json)},
          {"options", core::mapped<Json>(command.options, option_json)},
          {"commands", core::mapped<Json>(command.commands, command_json)}};
}

Json status_json(const ExitStatus& status) { return {{"status", status.status}, {"meaning", status.meaning}}; }

}  // namespace

std::string description_json(const CommandDescription& program, const std::string& version) {
  const Json all = {{"version", version},
                    {"program", command_json(program)},
                    {"exit_statuses", core::mapped<Json>(exit_statuses, status_json)}};
  return all.dump(1) + "\n";
}

}  // namespace dmpc::apps
