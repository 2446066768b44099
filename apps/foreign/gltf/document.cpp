#include "apps/foreign/gltf/document.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

#include "apps/frontend/line/number_text.h"
#include "core/base/expect.h"

namespace dmpc::apps::gltf {
namespace {

using Bytes = std::span<const std::byte>;

constexpr std::size_t header_bytes = 12, chunk_header_bytes = 8;

std::string_view text_of(Bytes bytes) { return {reinterpret_cast<const char*>(bytes.data()), bytes.size()}; }

std::uint32_t word(Bytes bytes, std::size_t at) {
  std::uint32_t value = 0;
  std::memcpy(&value, bytes.data() + at, sizeof value);
  return value;
}

bool is_binary(Bytes file) { return text_of(file).substr(0, 4) == "glTF"; }

/// The first chunk of `rest`, which is cut off; it must be of this kind.
Bytes take_chunk(Bytes& rest, std::string_view kind) {
  const bool has_header = rest.size() >= chunk_header_bytes && text_of(rest).substr(4, 4) == kind;
  const std::size_t length = has_header ? word(rest, 0) : 0;
  if (!has_header || length > rest.size() - chunk_header_bytes) {
    throw core::InputError(has_header ? "the file ends within a chunk of " + std::to_string(length) + " bytes: it is cut short"
                                      : "this .glb has no chunk of JSON where it is expected");
  }
  const Bytes chunk = rest.subspan(chunk_header_bytes, length);
  rest = rest.subspan(chunk_header_bytes + length);
  return chunk;
}

nlohmann::json parse(Bytes text) {
  try {
    const std::string_view characters = text_of(text);
    return nlohmann::json::parse(characters.begin(), characters.end());
  } catch (const nlohmann::json::exception& error) {
    const std::string what = error.what();  // begins with the library's number of the fault
    throw core::InputError("is no glTF: its JSON breaks, " + what.substr(std::min(what.size(), what.find("] ") + 2)));
  }
}

/// Files of version 1 write it as a number, too.
void check_version(const Part& root) {
  const Part version = root.get("asset").get("version");
  const std::string text = version.is_number() ? rounded(version.as_number()) : version.as_text();
  if (!text.starts_with('2')) {
    version.fail(
        "the version is '" + text + "', expected 2.0" +
        (text.starts_with('1') ? ": have Assimp make that of it (assimp export IN OUT.glb), and look at the result" : ""));
  }
}

}  // namespace

Document parse_document(Bytes file) {
  Document document;
  if (is_binary(file)) {
    if (file.size() < header_bytes || word(file, 4) != 2) {
      throw core::InputError("is a .glb " + std::string(file.size() < header_bytes ? "that is cut short" : "of another version") +
                             ", expected glTF 2.0");
    }
    Bytes rest = file.subspan(header_bytes);
    document.json = parse(take_chunk(rest, "JSON"));
    if (rest.size() >= chunk_header_bytes && text_of(rest).substr(4, 3) == "BIN") {
      document.chunk = take_chunk(rest, std::string_view("BIN\0", 4));
    } else if (!rest.empty() && rest.size() < chunk_header_bytes) {
      throw core::InputError("the file ends within a chunk: it is cut short");
    }
  } else {
    document.json = parse(file);
  }
  check_version(document.root());
  return document;
}

}  // namespace dmpc::apps::gltf
