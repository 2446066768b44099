#include "apps/database/database_file.h"

#include <array>
#include <fstream>
#include <ostream>
#include <span>
#include <sstream>
#include <string_view>

#include "apps/database/stored_scene.h"
#include "apps/frontend/system/digest.h"
#include "apps/reader/packing.h"
#include "core/base/expect.h"
#include "core/database/database_parts.h"
#include "core/families/scenes.h"

namespace dmpc::apps {
namespace {

enum Section : std::size_t {
  origin_section,
  scene_section,
  summary,
  records,
  primitives,
  sources,
  planes,
  collapsed,
  close,
  sections
};

/// Of two small databases, by the builders of this program, and of what else it writes: another program with the same one builds
/// what this one does.
std::uint64_t digest_of_program() {
  static const std::uint64_t value = [] {
    Digest digest;
    digest.add(std::string_view(DMPC_VERSION));
    for (const char* const name : {"mount-3", "rings-1"}) {
      const core::Database database = core::build_database(core::built_in_scene(core::parse_scene_name(name)), {.threads = 1});
      digest.add(database.bytes());
    }
    for (const std::size_t bytes : {sizeof(core::DatabaseSummary), sizeof(core::PrimitiveValues), sizeof(core::CloseFaces),
                                    sizeof(core::PrimitivePlane), sizeof(core::Material), sizeof(core::View)}) {
      digest.add(std::uint64_t{bytes});
    }
    return digest.value();
  }();
  return value;
}

FileKind database_kind() {
  return {.magic = 0x6567617063706d64U,  // "dmpcpage" in the order of the file
          .format = 1,
          .program = digest_of_program(),
          .what = "a database that dmpc build has written",
          .advice = "build it again: dmpc build SCENE -o FILE.pages"};
}

std::string packed(const DatabaseOrigin& origin) {
  Packer packer;
  packer.add_text(origin.scene).add(origin.source).add(std::uint32_t(origin.words.size()));
  for (const std::string& word : origin.words) {
    packer.add_text(word);
  }
  packer.add(std::uint32_t(origin.facts.size()));
  for (const auto& [name, value] : origin.facts) {
    packer.add_text(name).add_text(value);
  }
  return packer.bytes();
}

/// What work() makes of the file's bytes, or a complaint about them.
template <class Work>
auto of_file(const SectionFile& file, const Work& work) {
  try {
    return work();
  } catch (const Nonsense&) {
    file.refuse("it is damaged");
  }
}

}  // namespace

std::uint64_t source_of(const OpenedFiles& files) {
  Digest digest;
  for (const std::filesystem::path& path : files.paths()) {
    std::ostringstream text;
    text << std::ifstream(path, std::ios::binary).rdbuf();
    digest.add(digest_of(std::as_bytes(std::span(text.view()))));
  }
  return digest.value();
}

bool is_database_path(const std::string& scene) { return scene.ends_with(".pages"); }

void write_database(const DatabaseOrigin& origin, const core::Scene& scene, const core::Database& database,
                    std::ostream& output) {
  const std::string origin_bytes = packed(origin), scene_bytes = packed_scene(scene);
  const core::DatabaseParts parts = core::DatabaseParts::of(database);
  const auto bytes = [](const auto& items) { return std::as_bytes(items); };
  const std::array<std::span<const std::byte>, sections> all = {
      bytes(std::span(origin_bytes)), bytes(std::span(scene_bytes)),   bytes(std::span(&parts.summary, 1)),
      parts.records.items(),          bytes(parts.primitives.items()), bytes(parts.sources.items()),
      bytes(parts.planes.items()),    bytes(parts.collapsed.items()),  bytes(parts.close_faces.items())};
  write_sections(database_kind(), all, output);
}

DatabaseFile::DatabaseFile(const std::filesystem::path& path) : file_(path, database_kind(), sections) {}

DatabaseFile::DatabaseFile(const StoredChoice& chosen) : DatabaseFile(chosen.path) {
  if (digest() != chosen.digest) {
    refuse("it has been replaced since the command began");
  }
}

DatabaseOrigin DatabaseFile::origin() const {
  return of_file(file_, [&] {
    const std::string bytes = file_.text(origin_section);
    Unpacker fields(bytes);
    DatabaseOrigin origin{.scene = fields.take_text(), .words = {}, .facts = {}};
    origin.source = fields.take<std::uint64_t>();
    for (auto left = fields.take<std::uint32_t>(); left > 0; --left) {
      origin.words.push_back(fields.take_text());
    }
    for (auto left = fields.take<std::uint32_t>(); left > 0; --left) {
      std::string name = fields.take_text();
      origin.facts.emplace_back(std::move(name), fields.take_text());
    }
    fields.finish();
    return origin;
  });
}

core::Scene DatabaseFile::scene() const {
  return of_file(file_, [&] { return unpacked_scene(file_.text(scene_section)); });
}

core::Database DatabaseFile::database() const {
  const auto summaries = file_.array<core::DatabaseSummary>(summary);
  if (summaries.items().size() != 1) {
    file_.refuse("it is damaged");
  }
  core::DatabaseParts parts{.summary = summaries.items().front(),
                            .records = file_.array<std::byte>(records),
                            .primitives = file_.array<core::PrimitiveValues>(primitives),
                            .sources = file_.array<core::PrimitiveSource>(sources),
                            .planes = file_.array<core::PrimitivePlane>(planes),
                            .collapsed = file_.array<core::CollapsedPrimitive>(collapsed),
                            .close_faces = file_.array<core::CloseFaces>(close)};
  try {
    return std::move(parts).assembled();
  } catch (const core::InputError& error) {
    file_.refuse(error.what());
  }
}

}  // namespace dmpc::apps
