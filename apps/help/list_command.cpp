#include "apps/help/list_command.h"

#include <algorithm>
#include <ostream>

#include "apps/frontend/line/typed_line.h"
#include "apps/frontend/line/words.h"
#include "apps/frontend/system/output_file.h"
#include "apps/frontend/table/table.h"
#include "apps/help/choices.h"
#include "apps/help/gallery.h"
#include "core/base/expect.h"
#include "core/base/nearest_word.h"
#include "core/base/ranges.h"

namespace dmpc::apps {
namespace {

std::vector<std::string> kinds() { return std::vector<std::string>(choice_kinds.begin(), choice_kinds.end()); }

std::string kind_named(const std::string& word) {
  const std::vector<std::string> all = kinds();
  if (std::find(all.begin(), all.end(), word) == all.end()) {
    const std::string meant = core::did_you_mean(word, all);
    throw core::UsageError("there is no list of " + word + ": expected " + listed(all) + (meant.empty() ? "" : ".") + meant);
  }
  return word;
}

std::vector<ChoiceList> chosen(const ListOptions& options) {
  std::vector<ChoiceList> all = all_choices();
  if (options.kinds.empty()) {
    return all;
  }
  return core::mapped<ChoiceList>(options.kinds, [&](const std::string& kind) {
    return *std::find_if(all.begin(), all.end(), [&](const ChoiceList& one) { return one.kind == kind; });
  });
}

std::string text_of_list(const ChoiceList& list) {
  const std::size_t width =
      core::max_over(list.entries, std::size_t{0}, [&](const Choice& entry) { return entry.name.size() + 2; });
  return list.kind + " (" + list.where + ")\n" + joined(list.entries, "", [&](const Choice& entry) {
           return "  " + entry.name + std::string(width - entry.name.size(), ' ') + entry.meaning + "\n";
         });
}

/// One row a word.
Table table_of(const std::vector<ChoiceList>& lists) {
  Table table("Available choices", {{"kind"}, {"name"}, {"meaning"}});
  for (const ChoiceList& list : lists) {
    for (const Choice& entry : list.entries) {
      table.add_row({list.kind, entry.name, entry.meaning});
    }
  }
  return table;
}

}  // namespace

void add_options(OptionSet options, ListOptions& list) {
  options.add_arguments(
      "KIND", [&list](const std::string& word) { list.kinds.push_back(kind_named(word)); },
      "One of " + listed(kinds()) + "; all if none is given");
  options.add_choice<ListFormat>("--format", list.format, {{"text", ListFormat::text}, {"json", ListFormat::json}},
                                 "Text, or a JSON table with stable keys");
  options.add_path("--pictures", "FOLDER", list.pictures,
                   "Write a small picture of each scene, and scenes.png with all of them, to this folder; only scenes are listed "
                   "then. Existing files are not overwritten");
  options.check_in_the_end([&list] {
    if (list.pictures && list.kinds.empty()) {
      list.kinds = {"scenes"};
    }
    if (list.pictures && list.kinds != std::vector<std::string>{"scenes"}) {
      throw core::UsageError("--pictures goes with the list of scenes alone: dmpc list --pictures=" + list.pictures->string());
    }
  });
  options.set_examples(
      "Examples:\n"
      "  dmpc list scenes\n"
      "  dmpc list machines policies --format=json\n"
      "  dmpc list --pictures=scenes\n"
      "dmpc scene --help shows the sizes of scenes, dmpc machine NAME all parameters of a machine with their sources.");
}

int list_command(const ListOptions& options, Interrupt& interrupt, std::ostream& output) {
  if (options.pictures) {
    write_gallery(*options.pictures, interrupt);
  }
  const std::vector<ChoiceList> lists = chosen(options);
  if (options.format == ListFormat::json) {
    output << text_of(table_of(lists), TableFormat::json);
  }
  for (std::size_t i = 0; options.format == ListFormat::text && i < lists.size(); ++i) {
    output << (i == 0 ? "" : "\n") << text_of_list(lists[i]);
  }
  finish_output(output, "the list");
  return 0;
}

}  // namespace dmpc::apps
