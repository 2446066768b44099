#include "apps/computer/page_words.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <vector>

namespace dmpc::apps {
namespace {

/// What dmpc itself says of rays and pictures, in words for any program.
constexpr std::array own_words = {
    GlossaryEntry{"chaos", "A seed disturbs the computer: packets are held back, nodes pause, credits shrink."},
    GlossaryEntry{"computing", "Time in which a node's program works, by the operations that it charges."},
    GlossaryEntry{"home", "The node that keeps a page for good and sends it to those who ask."},
    GlossaryEntry{"hop", "A step of a message over one link."},
    GlossaryEntry{"look-up", "The question for one place in the data, and so for the page that it lies in."},
    GlossaryEntry{"miss", "A look-up that does not find its page. Several misses that wait for one page are one fault."},
    GlossaryEntry{"packet", "What a node sends to another at once: a short head and what the program puts into it."},
    GlossaryEntry{"page", "A numbered piece of the data, all of one size."},
    GlossaryEntry{"refused", "Packets that a program tried to send while it might not."},
    GlossaryEntry{"run hash", "A digest of all events in virtual time and the machine: equal runs have equal hashes."},
    GlossaryEntry{"virtual time", "The modelled machine's clock. It does not depend on the computer that the program runs on."},
    GlossaryEntry{"wall clock", "Time on the computer that the program runs on."},
    GlossaryEntry{"step", "One call of a task; where its page is not there the task is called again when it has come."},
};

/// What dmpc says of these, any program would.
constexpr std::array<std::string_view, 14> common_words = {"asleep", "cache",  "eviction",        "fault",   "fetch",
                                                           "lru",    "node",   "idle at the end", "lent",    "link",
                                                           "p95",    "stolen", "stack distance",  "topology"};

std::vector<GlossaryEntry> all_words() {
  std::vector<GlossaryEntry> all(own_words.begin(), own_words.end());
  for (const GlossaryEntry& entry : glossary()) {
    if (std::find(common_words.begin(), common_words.end(), entry.word) != common_words.end()) {
      all.push_back(entry);
    }
  }
  std::sort(all.begin(), all.end(), [](const GlossaryEntry& a, const GlossaryEntry& b) { return a.word < b.word; });
  return all;
}

}  // namespace

std::span<const GlossaryEntry> page_words() {
  static const std::vector<GlossaryEntry> all = all_words();
  return all;
}

}  // namespace dmpc::apps
