#include "apps/edge/line/fitted_help.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <iostream>
#include <sstream>

#include "apps/edge/line/folded_text.h"
#include "apps/edge/line/help_text.h"

namespace dmpc::apps {
namespace {

/// Below this there is too little room beside names.
constexpr std::size_t explanation_min = 36;
constexpr std::size_t narrow_indent = 8;

/// Letters in a line of the terminal that the standard output is; 0 if it is none, or does not say.
std::size_t terminal_width() {
  winsize size{};
  return ::isatty(STDOUT_FILENO) == 1 && ::ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 ? size.ws_col : 0;
}

bool is_explanation(const std::string& line) {
  return line.size() > help_column && line.starts_with("  ") && line[help_column - 1] == ' ' && line[help_column] != ' ';
}

std::string with_indent(const std::string& text, std::size_t width, std::size_t indent) {
  std::istringstream lines(folded(text, width > indent ? width - indent : 1, ""));
  std::string result;
  for (std::string line; std::getline(lines, line);) {
    result += (result.empty() ? "" : "\n" + std::string(indent, ' ')) + line;
  }
  return result;
}

std::string fitted_explanation(const std::string& line, std::size_t width) {
  const std::string names = line.substr(0, help_column), text = line.substr(help_column);
  if (width >= help_column + explanation_min) {
    return names + with_indent(text, width, help_column);
  }
  const std::size_t end = names.find_last_not_of(' ');
  const std::string above = end == std::string::npos ? "" : names.substr(0, end + 1) + "\n";
  return above + std::string(narrow_indent, ' ') + with_indent(text, width, narrow_indent);
}

}  // namespace

std::string fitted_help(const std::string& text, std::size_t width) {
  std::istringstream lines(text);
  std::string result;
  for (std::string line; std::getline(lines, line);) {
    const bool fits = line.size() <= width || (line.starts_with(' ') && !is_explanation(line));
    result += (fits ? line : is_explanation(line) ? fitted_explanation(line, width) : with_indent(line, width, 0)) + "\n";
  }
  return result;
}

void print_help(std::ostream& output, const std::string& text) {
  const std::size_t width = &output == &std::cout ? terminal_width() : 0;
  output << (width > 0 ? fitted_help(text, width) : text);
}

}  // namespace dmpc::apps
