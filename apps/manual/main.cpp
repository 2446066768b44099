// Writes the manual page, the completion script, the schema of --stats and the calls of the module for Python, when the program
// is built: dmpc_manual FOLDER.

#include <algorithm>
#include <cctype>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "apps/frontend/line/command_description.h"
#include "apps/frontend/line/words.h"
#include "apps/frontend/manual/completion.h"
#include "apps/frontend/manual/man_page.h"
#include "apps/main/commands.h"
#include "apps/show/stats/schema.h"
#include "core/base/expect.h"

namespace dmpc::apps {
namespace {

constexpr std::size_t line_width = 140;
constexpr const char* origin =
    "Written by dmpc_manual_writer (apps/manual) from what the program says of its options: not to be edited. Where a test says "
    "that they\n"
    "differ: cp build/release/apps/manual/*.py apps/python/dmpc/\n\"\"\"\n\n";

using Words = std::vector<std::string>;

/// How a command is called from Python.
struct Call {
  std::string name;
  const CommandDescription& command;
  std::set<std::string> own;  ///< options that the call sets itself
  std::string before;         ///< keywords that stand before the options
  std::string result, body;   ///< its type, and what it returns; of a study the body is made by positions
  bool are_several = false;   ///< each option takes several values
};

/// "--node-memory" as "node_memory".
std::string keyword_of(const OptionDescription& option) {
  std::string name = option.names.empty() ? option.value : option.names.back();
  name.erase(0, name.find_first_not_of('-'));
  name = name.substr(0, name.find_first_of(".["));
  std::transform(name.begin(), name.end(), name.begin(),
                 [](unsigned char c) { return c == '-' ? '_' : static_cast<char>(std::tolower(c)); });
  return name;
}

/// The words of "svm|dataflow [svm]"; none if a value may be anything else.
Words choices_in(const std::string& shown) {
  Words words = words_between(shown.substr(0, shown.find(' ')), '|');
  const bool are_words = words.size() > 1 && std::all_of(words.begin(), words.end(), [](const std::string& word) {
                           return !word.empty() && std::all_of(word.begin(), word.end(), [](unsigned char c) {
                             return std::islower(c) || std::isdigit(c) || c == '-';
                           });
                         });
  return are_words ? words : Words();
}

bool is_number(const std::string& shown) {
  const std::string values = shown.substr(0, shown.find(' '));
  return values.find("..") != std::string::npos && values.find_first_not_of("0123456789.") == std::string::npos;
}

/// Type of one value.
std::string type_of(const OptionDescription& option) {
  Words choices = choices_in(option.value);
  for (std::string& word : choices) {
    word = '"' + word + '"';
  }
  return !choices.empty() ? "Literal[" + joined(choices, ", ") + "]" : is_number(option.value) ? "int" : "Text";
}

std::string parameter_of(const OptionDescription& option, bool are_several) {
  const bool is_flag = option.value.empty() || option.has_optional_value;
  std::string type = option.has_optional_value ? "bool | Text" : is_flag ? "bool" : type_of(option);
  if (are_several || (!is_flag && (option.is_repeatable || option.is_list))) {
    type += " | Sequence[" + (type.starts_with("Literal") ? "Text" : type) + "]";
  }
  return keyword_of(option) + ": " + type + (is_flag ? " = False" : " | None = None");
}

std::string argument_of(const OptionDescription& argument) {
  return keyword_of(argument) + (argument.is_list ? ": Text | Sequence[Text] = ()" : ": Text");
}

/// "    a, b,\n    c", filled.
std::string filled(const Words& parts) {
  std::istringstream words(joined(parts, ", "));
  std::string text, line = "   ";
  for (std::string word; words >> word;) {
    if (line.size() + 1 + word.size() > line_width) {
      text += line + "\n";
      line = "   ";
    }
    line += " " + word;
  }
  return text + line;
}

std::string function(const Call& call) {
  Words parts, positions;
  for (const OptionDescription& argument : call.command.arguments) {
    parts.push_back(argument_of(argument));
    positions.push_back('"' + keyword_of(argument) + '"');
  }
  parts.emplace_back("*");
  if (!call.before.empty()) {
    parts.push_back(call.before);
  }
  for (const OptionDescription& option : call.command.options) {
    if (!call.own.contains(keyword_of(option))) {
      parts.push_back(parameter_of(option, call.are_several));
    }
  }
  const std::string body = call.body.empty()
                               ? "studying.study(\"" + call.command.name + "\", [" + joined(positions, ", ") + "], locals())"
                               : call.body;
  return "\n\ndef " + call.name + "(\n" + filled(parts) + "\n) -> " + call.result + ":\n    \"\"\"" + call.command.text +
         ".\"\"\"\n    return " + body + "\n";
}

const CommandDescription& command_of(const CommandDescription& outer, const std::string& name) {
  const auto found = std::find_if(outer.commands.begin(), outer.commands.end(),
                                  [&](const CommandDescription& command) { return command.name == name; });
  core::expect(found != outer.commands.end(), "a command that Python calls is there");
  return *found;
}

std::string joined_calls(const std::vector<Call>& calls) {
  return joined(calls, "", [&](const Call& call) { return function(call); });
}

void collect(const CommandDescription& outer, std::set<std::string>& with_commas, std::set<std::string>& repeated) {
  for (const OptionDescription& option : outer.options) {
    if (option.is_repeatable) {
      repeated.insert(keyword_of(option));
    } else if (option.is_list) {
      with_commas.insert(keyword_of(option));
    }
  }
  for (const CommandDescription& command : outer.commands) {
    collect(command, with_commas, repeated);
  }
}

/// Options of frames, which are many pictures, and a call returns one.
std::set<std::string> with_frames(std::set<std::string> own) {
  own.insert({"frames", "turntable", "camera_path", "animation", "fps"});
  return own;
}

bool prints_a_table(const CommandDescription& study) {
  return std::any_of(study.options.begin(), study.options.end(),
                     [](const OptionDescription& option) { return keyword_of(option) == "format"; });
}

std::string python_commas(const CommandDescription& program) {
  std::set<std::string> with_commas, repeated;
  collect(program, with_commas, repeated);
  Words names;
  for (const std::string& name : with_commas) {
    if (!repeated.contains(name)) {
      names.push_back('"' + name + '"');
    }
  }
  return "\"\"\"Options whose several values have commas between; others that take several are given several times.\n\n" +
         std::string(origin) + "WITH_COMMAS = {\n" + filled(names) + "\n}\n";
}

/// The files calls.py, study.py and commas.py of apps/python/dmpc: a function for each command that has one, whose keywords are
/// the command's options, so that whoever types them is offered what there is; and which values have commas between. `program`
/// has all commands.
std::string python_calls(const CommandDescription& program) {
  const CommandDescription &render = command_of(program, "render"), &compare = command_of(program, "compare"),
                           &sweep = command_of(command_of(program, "study"), "sweep");
  return "\"\"\"What dmpc does, as functions; every option of the program's command is a keyword, with underscores for "
         "dashes.\n\n" +
         std::string(origin) +
         "from collections.abc import Sequence\nfrom typing import Literal\n\nimport pandas\n\n"
         "from . import comparing, looking, rendering, sweeping\nfrom .program import Text\nfrom .rendering import Render\n" +
         joined_calls({
             {"render", render, with_frames({"help", "output", "stats", "heatmap", "quiet"}), "heat: Text | Sequence[Text] = ()",
              "Render", "rendering.render(locals())"},
             {"sweep",
              sweep,
              {"help", "vary", "format", "output", "quiet"},
              "",
              "pandas.DataFrame",
              "sweeping.sweep(locals())",
              true},
             {"references", render, with_frames({"help", "output", "references", "quiet"}), "", "pandas.DataFrame",
              "looking.references(locals())"},
             {"trace", render, with_frames({"help", "output", "trace", "quiet"}), "", "pandas.DataFrame",
              "looking.trace(locals())"},
             {"compare", compare, {"help", "format"}, "", "dict", "comparing.compare(locals())"},
         });
}

std::string python_studies(const CommandDescription& program) {
  std::vector<Call> calls;
  for (const CommandDescription& study : command_of(program, "study").commands) {
    if (study.name != "sweep") {
      const bool is_table = prints_a_table(study);
      calls.push_back(
          {study.name, study,
           is_table ? std::set<std::string>{"help", "format", "output", "quiet"} : std::set<std::string>{"help", "quiet"}, "",
           is_table ? "pandas.DataFrame" : "str", ""});
    }
  }
  return "\"\"\"The studies: each returns its table as a frame, with units and notes in its attrs.\n\n" + std::string(origin) +
         "from collections.abc import Sequence\nfrom typing import Literal\n\nimport pandas\n\n"
         "from . import studying\nfrom .calls import sweep\nfrom .program import Text\n\n"
         "__all__ = [" +
         [&] {
           Words names = {"\"sweep\""};
           for (const Call& call : calls) {
             names.push_back('"' + call.name + '"');
           }
           return joined(names, ", ");
         }() +
         "]\n" + joined_calls(calls);
}

void write(const std::filesystem::path& path, const std::string& text) {
  std::ofstream stream(path, std::ios::binary);
  stream << text << std::flush;
  if (!stream) {
    throw core::InputError(path.string() + " cannot be written");
  }
}

void write_manual(const std::filesystem::path& folder) {
  const CommandDescription program = describe_command_line();
  std::filesystem::create_directories(folder);
  write(folder / "dmpc.1", man_page(program, "dmpc " DMPC_VERSION));
  write(folder / "dmpc.bash", bash_completion(program));
  write(folder / "stats.schema.json", stats_schema());
  write(folder / "calls.py", python_calls(program));
  write(folder / "study.py", python_studies(program));
  write(folder / "commas.py", python_commas(program));
}

}  // namespace

}  // namespace dmpc::apps

int main(int count, char** values) {
  if (count != 2) {
    std::cerr << "usage: dmpc_manual FOLDER" << std::endl;
    return 2;
  }
  try {
    dmpc::apps::write_manual(values[1]);
    return 0;
  } catch (const std::exception& error) {
    std::cerr << "dmpc_manual: " << error.what() << std::endl;
    return 1;
  }
}
