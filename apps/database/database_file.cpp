#include "apps/database/database_file.h"

#include <array>
#include <fstream>
#include <ostream>
#include <span>
#include <sstream>
#include <string_view>

#include "apps/database/stored_scene.h"
#include "apps/frontend/line/parsed_number.h"
#include "apps/frontend/line/words.h"
#include "apps/frontend/system/digest.h"
#include "core/base/expect.h"
#include "core/database/database_parts.h"
#include "core/families/scenes.h"

namespace dmpc::apps {
namespace {

enum Section : std::size_t {
  origins,
  words,
  facts,
  names,
  identity,
  scene_summary,
  lights,
  materials,
  textures,
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
          .format = 2,                   // 2: trees select emitters and tiles of a sky, of which those small databases have none
          .program = digest_of_program(),
          .what = "a database that dmpc build has written",
          .advice = "build it again: dmpc build SCENE -o FILE.pages"};
}

/// Each with a zero behind.
std::string packed(const std::vector<std::string>& texts) {
  std::string all;
  for (const std::string& text : texts) {
    all += text + '\0';
  }
  return all;
}

std::vector<std::string> unpacked(const std::string& texts) {
  std::vector<std::string> all = words_between(texts, '\0');
  all.pop_back();
  return all;
}

template <class Pairs>
std::string packed_pairs(const Pairs& pairs) {
  std::vector<std::string> texts;
  for (const auto& [name, value] : pairs) {
    texts.insert(texts.end(), {name, value});
  }
  return packed(texts);
}

DatabaseFacts unpacked_pairs(const std::string& texts) {
  DatabaseFacts pairs;
  const std::vector<std::string> all = unpacked(texts);
  for (std::size_t i = 0; i + 1 < all.size(); i += 2) {
    pairs.emplace_back(all[i], all[i + 1]);
  }
  return pairs;
}

template <class T>
std::span<const std::byte> bytes_of(const T& items) {
  return std::as_bytes(std::span(items));
}
template <class T>
std::span<const std::byte> bytes_of_one(const T& value) {
  return std::as_bytes(std::span(&value, 1));
}

template <class T>
std::vector<T> listed(const SectionFile& file, Section section) {
  const auto items = file.array<T>(section);
  return {items.items().begin(), items.items().end()};
}

template <class T>
T single(const SectionFile& file, Section section) {
  const auto items = file.array<T>(section);
  if (items.items().size() != 1) {
    file.refuse("it is damaged");
  }
  return items.items().front();
}

/// What work() makes of what was read, or a complaint about the file.
template <class Work>
auto of_file(const SectionFile& file, const Work& work) {
  try {
    return work();
  } catch (const core::InputError& error) {
    file.refuse(error.what());
  }
}

}  // namespace

bool is_database_path(const std::string& scene) { return scene.ends_with(".pages"); }

std::uint64_t source_of(const OpenedFiles& files) {
  Digest digest;
  for (const std::filesystem::path& path : files.paths()) {
    std::ostringstream text;
    text << std::ifstream(path, std::ios::binary).rdbuf();
    digest.add(digest_of(std::as_bytes(std::span(text.view()))));
  }
  return digest.value();
}

void write_database(const DatabaseOrigin& origin, const core::Scene& scene, const core::Database& database,
                    std::ostream& output) {
  const StoredScene left = StoredScene::of(scene);
  const core::DatabaseParts parts = core::DatabaseParts::of(database);
  const std::string origin_text = packed({origin.scene, std::to_string(origin.source)}), words_text = packed(origin.words),
                    facts_text = packed_pairs(origin.facts), names_text = packed(left.names),
                    identity_text = packed_pairs(left.identity);
  std::array<std::span<const std::byte>, sections> all;
  all[origins] = bytes_of(origin_text);
  all[words] = bytes_of(words_text);
  all[facts] = bytes_of(facts_text);
  all[names] = bytes_of(names_text);
  all[identity] = bytes_of(identity_text);
  all[scene_summary] = bytes_of_one(left.summary);
  all[lights] = bytes_of(left.lights);
  all[materials] = bytes_of(left.materials);
  all[textures] = bytes_of(left.textures);
  all[summary] = bytes_of_one(parts.summary);
  all[records] = parts.records.items();
  all[primitives] = bytes_of(parts.primitives.items());
  all[sources] = bytes_of(parts.sources.items());
  all[planes] = bytes_of(parts.planes.items());
  all[collapsed] = bytes_of(parts.collapsed.items());
  all[close] = bytes_of(parts.close_faces.items());
  write_sections(database_kind(), all, output);
}

DatabaseFile::DatabaseFile(const std::filesystem::path& path) : file_(path, database_kind(), sections) {}

DatabaseFile::DatabaseFile(const StoredChoice& chosen) : DatabaseFile(chosen.path) {
  if (digest() != chosen.digest) {
    refuse("it has been replaced since the command began");
  }
}

DatabaseOrigin DatabaseFile::origin() const {
  const std::vector<std::string> texts = unpacked(file_.text(origins));
  const auto source = texts.size() == 2 ? number_in<std::uint64_t>(texts[1]) : std::nullopt;
  if (!source) {
    file_.refuse("it is damaged");
  }
  return {texts[0], unpacked(file_.text(words)), unpacked_pairs(file_.text(facts)), *source};
}

core::Scene DatabaseFile::scene() const {
  const DatabaseFacts pairs = unpacked_pairs(file_.text(identity));
  const StoredScene left{.summary = single<StoredScene::Summary>(file_, scene_summary),
                         .lights = listed<core::PointLight>(file_, lights),
                         .materials = listed<core::Material>(file_, materials),
                         .textures = listed<StoredTexture>(file_, textures),
                         .names = unpacked(file_.text(names)),
                         .identity = {pairs.begin(), pairs.end()}};
  return of_file(file_, [&] { return left.scene(); });
}

core::Database DatabaseFile::database() const {
  core::DatabaseParts parts{.summary = single<core::DatabaseSummary>(file_, summary),
                            .records = file_.array<std::byte>(records),
                            .primitives = file_.array<core::PrimitiveValues>(primitives),
                            .sources = file_.array<core::PrimitiveSource>(sources),
                            .planes = file_.array<core::PrimitivePlane>(planes),
                            .collapsed = file_.array<core::CollapsedPrimitive>(collapsed),
                            .close_faces = file_.array<core::CloseFaces>(close)};
  return of_file(file_, [&] { return std::move(parts).assembled(); });
}

}  // namespace dmpc::apps
