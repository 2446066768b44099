// Any bytes as a machine file, if they begin with a brace, else as the options of `render`, one a line: refused with
// core::InputError or core::UsageError, or accepted and within the ranges that are promised.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "apps/frontend/line/command_line.h"
#include "apps/frontend/line/option_values.h"
#include "apps/frontend/machine/machine_file.h"
#include "apps/run/render_options.h"
#include "core/base/expect.h"
#include "tests/fuzz/targets.h"

namespace dmpc::fuzz {

namespace {

using core::expect;
using Lines = std::vector<std::string>;

constexpr std::size_t lines_max = 32;

/// What `parse` makes of it, or nothing if it throws `Refusal`.
template <class Refusal, class Parse>
auto accepted(const Parse& parse) -> std::optional<decltype(parse())> {
  try {
    return parse();
  } catch (const Refusal& error) {
    expect(!std::string_view(error.what()).empty(), "who refuses says why");
    return std::nullopt;
  }
}

void try_machine(const std::string& text) {
  const auto parse = [](const std::string& json) {
    return accepted<core::InputError>([&] { return apps::parse_machine(json, "input"); });
  };
  const auto machine = parse(text);
  covered().count("machine read", machine.has_value());
  covered().count("machine refused", !machine);
  if (machine) {
    expect(machine->machine.has_contention || !machine->machine.has_memory_port, "ports need contention");
    expect(!machine->machine.name.empty() && machine->machine.name.size() <= 64, "a name has 1 to 64 characters");
    const std::string written = apps::machine_text(*machine);
    const auto again = parse(written);
    expect(again.has_value(), "a machine that is written is read");
    expect(apps::machine_text(*again) == written, "a machine that is written and read again has the same text");
    expect(again->machine.digest() == machine->machine.digest(), "a machine that is written and read again has the same figures");
    expect(again->machine.name == machine->machine.name && again->sources == machine->sources, "names and sources stay");
  }
}

bool is_possible(const apps::Resolution& size) {
  return size.width > 0 && size.height > 0 && std::int64_t{size.width} * size.height <= apps::picture_pixels_max;
}

void try_value(const std::string& text) {
  using core::UsageError;
  const auto size = accepted<UsageError>([&] { return apps::parse_size_bytes(text, "--size"); });
  covered().count("a size taken", size.has_value());
  covered().count("a size refused", !size);
  expect(!size || *size <= std::size_t{1} << 40U, "a size is a TiB at most");
  const auto page = accepted<UsageError>([&] { return apps::parse_page_size(text); });
  expect(!page || (size == page && *page >= 512 && *page <= 65536), "a page's size is a size, from 512 B to 64 KiB");
  const auto resolution = accepted<UsageError>([&] { return apps::parse_resolution(text); });
  expect(!resolution || is_possible(*resolution), "a resolution has a pixel, and not too many");
  const auto seed = accepted<UsageError>([&] { return apps::parse_seed(text, "--seed"); });
  const auto again = accepted<UsageError>([&] { return apps::parse_seed(std::to_string(seed.value_or(0)), "--seed"); });
  expect(!seed || again == seed, "a seed that is written is read");
}

void check(const apps::RenderOptions& render) {
  expect(!render.picture.resolution || is_possible(*render.picture.resolution), "a resolution has a pixel, and not too many");
  expect(render.computer.node_count >= 1, "there is a node");
  expect(render.picture.samples >= 1 && render.picture.samples <= 32768, "samples are 1 to 32768");
  expect(render.picture.depth >= 1 && render.picture.depth <= 255, "the depth is 1 to 255");
}

void try_options(Lines lines) {
  lines.insert(lines.begin(), "render");
  apps::CommandLine line("description", "version", "examples");
  apps::RenderOptions render;
  add_options(line.add_command("render", "description"), render);
  const auto parsed = accepted<core::UsageError>([&] { return line.parse(lines); });
  covered().count("options taken", parsed.has_value());
  covered().count("options refused", !parsed);
  if (parsed && std::holds_alternative<std::string>(*parsed)) {
    check(render);
  }
}

Lines lines_of(const std::string& text) {
  Lines lines;
  std::istringstream stream(text);
  for (std::string line; lines.size() < lines_max && std::getline(stream, line);) {
    lines.push_back(line);
  }
  return lines;
}

}  // namespace

void try_machine(const std::uint8_t* data, std::size_t size) {
  const std::string text(data, data + size);
  if (text.starts_with('{')) {
    try_machine(text);
  } else if (text.starts_with('-')) {
    try_options(lines_of(text));
  } else {
    for (const std::string& line : lines_of(text)) {
      try_value(line);
    }
  }
}

}  // namespace dmpc::fuzz
