#include "apps/foreign/obj/libraries.h"

#include <memory>
#include <utility>

#include "apps/foreign/mesh/count_note.h"
#include "apps/foreign/text/line_words.h"
#include "apps/formats/named_file.h"
#include "apps/frontend/line/shown_text.h"
#include "core/base/expect.h"

namespace dmpc::apps::obj {

Libraries::Libraries(const std::vector<std::string>& wanted, const std::filesystem::path& scene, SceneFiles& files)
    : folder_(scene.parent_path()), files_(files) {
  for (const std::string& name : wanted) {
    wanted_.insert(name);
    wanted_.emplace(without_remark(name));
  }
}

bool Libraries::is_there(const std::string& name) { return !files_.meant(folder_, name).empty(); }

void Libraries::read(const std::string& names) {
  const std::string plain(plain_name(names));
  std::vector<std::string> list;
  LineWords words(names, 1);
  for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
    list.emplace_back(plain_name(word));
  }
  if (names != plain && is_there(names)) {
    list = {names};
  } else if (list.size() < 2 || is_there(plain)) {
    list = {plain};
  }
  for (const std::string& name : list) {
    if (read_.insert(name).second) {
      read_file(name);
    }
  }
}

void Libraries::read_file(const std::string& name) {
  const std::vector<std::filesystem::path> found = files_.meant(folder_, name);
  const std::filesystem::path path = found.empty() ? folder_ / name : found.front();
  std::unique_ptr<FileBytes> file;
  try {
    file = files_.open(path.string());
  } catch (const core::InputError& error) {
    missing.emplace_back(error.what());
    return;
  }
  if (is_under_other_name(folder_, name, path)) {
    notes.push_back("a file of materials was found under another name: " + path.filename().string() + " for " + name);
  }
  std::vector<std::string> said;
  try {
    parse_mtl(
        text_of(*file), [this](MtlMaterial material) { take(std::move(material)); }, said);
  } catch (const core::InputError& error) {
    throw core::InputError(clipped(name) + ": " + error.what());
  }
  for (const std::string& note : said) {
    notes.push_back(clipped(name) + ": " + note);
  }
}

void Libraries::take(MtlMaterial material) {
  const std::string short_name(without_remark(material.name));
  if (!wanted_.contains(material.name) && !wanted_.contains(short_name)) {
    return;
  }
  if (!names_.try_emplace(material.name, materials_.size()).second) {
    ++repeated_;
    return;
  }
  short_names_.try_emplace(short_name, materials_.size());
  if (material.texture) {
    const std::string plain(plain_name(material.texture->name));
    material.texture->name =
        plain != material.texture->name && !is_there(material.texture->name) ? plain : material.texture->name;
  }
  materials_.push_back(std::move(material));
}

const MtlMaterial* Libraries::find(const std::string& name) const {
  const std::string_view short_name = without_remark(name);
  for (const auto& [names, wanted] :
       {std::pair(&names_, std::string_view(name)), {&names_, short_name}, {&short_names_, short_name}}) {
    if (const auto found = names->find(wanted); found != names->end()) {
      return &materials_[found->second];
    }
  }
  return nullptr;
}

void Libraries::note_repeated(std::vector<std::string>& all) const {
  note_count(all, "materials that are there again, of which the first is shown", repeated_);
}

}  // namespace dmpc::apps::obj
