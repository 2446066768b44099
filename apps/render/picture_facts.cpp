#include "apps/render/picture_facts.h"

#include <algorithm>
#include <iterator>

namespace dmpc::apps {

namespace {

const PictureFact* find(const std::vector<PictureFact>& facts, const std::string& name) {
  const auto found = std::find_if(facts.begin(), facts.end(), [&](const PictureFact& fact) { return fact.name == name; });
  return found == facts.end() ? nullptr : &*found;
}

/// How one fact differs; nullptr if a picture has none of the name.
std::string difference_text(const std::string& name, const PictureFact* other, const PictureFact* here) {
  if (other != nullptr && here != nullptr && other->value == here->value) {
    return "";
  }
  if (other == nullptr || here == nullptr) {
    return other == nullptr ? "no " + name : name + " is " + other->value + ", here there is none";
  }
  return other->value.starts_with('#') ? "other " + name : name + " is " + other->value + ", here " + here->value;
}

}  // namespace

std::string difference_text(const std::vector<PictureFact>& other, const std::vector<PictureFact>& here) {
  std::vector<PictureFact> all = other;
  std::copy_if(here.begin(), here.end(), std::back_inserter(all),
               [&](const PictureFact& fact) { return find(other, fact.name) == nullptr; });
  std::string text;
  for (const PictureFact& fact : all) {
    const std::string difference = difference_text(fact.name, find(other, fact.name), find(here, fact.name));
    text += (text.empty() || difference.empty() ? "" : "; ") + difference;
  }
  return text;
}

}  // namespace dmpc::apps
