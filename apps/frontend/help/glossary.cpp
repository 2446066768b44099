#include "apps/frontend/help/glossary.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>

#include "apps/frontend/run/time_parts.h"
#include "core/base/ranges.h"

namespace dmpc::apps {

namespace {

constexpr std::array entries = {
    GlossaryEntry{"asleep", "A node is asleep while it waits for a packet and has nothing else to do."},
    GlossaryEntry{"backlog", "The rays that a node has accepted and not finished."},
    GlossaryEntry{"base mesh", "A mesh that is stored once and drawn in several places, its instances (--instances=keep)."},
    GlossaryEntry{"bundle", "Up to 16 rays of neighbouring pixels that traverse the scene together."},
    GlossaryEntry{"bvh",
                  "Bounding volume hierarchy: a tree of boxes in boxes. Its inner records are BVH nodes with up to eight "
                  "children, its leaves hold up to eight primitives."},
    GlossaryEntry{"cache", "The frames of a node's memory that hold pages of other homes."},
    GlossaryEntry{"chaos",
                  "A seed disturbs the computer: packets are delayed, nodes pause, credits shrink. The film stays the same."},
    GlossaryEntry{"coarse proxy", "The top levels of the whole database, small enough for every node to have (dataflow)."},
    GlossaryEntry{"computing", "The time in which a node traces and shades rays."},
    GlossaryEntry{"convention",
                  "Which shadow rays are traced: towards lights that the surface faces (haines), or towards all (paper, as the "
                  "article of 1994 counts)."},
    GlossaryEntry{"coplanar faces",
                  "Triangles that overlap in one plane. The first in the scene's file is visible; what lets light through lies "
                  "behind the others."},
    GlossaryEntry{"credit",
                  "The right to send one more packet or to start one more ray. It comes back when a slot is free again."},
    GlossaryEntry{"crossbar", "A network in which each node has a link of its own to every other node."},
    GlossaryEntry{"cutoff", "Rays that could contribute less light than this are not traced."},
    GlossaryEntry{"database", "The scene as flat records (grid, primitives, shading data, materials, lights), cut into pages."},
    GlossaryEntry{"database, stored",
                  "A file that dmpc build has written (FILE.pages), which stands for a scene and the options it was built with."},
    GlossaryEntry{"dataflow",
                  "The strategy in which rays travel: each node owns a region of space, and a ray goes to the owner of the "
                  "region it enters."},
    GlossaryEntry{"eviction", "A cached page is dropped, and its frame is used for another page."},
    GlossaryEntry{"extents", "One BVH over the whole scene, in place of a grid whose cells have BVHs."},
    GlossaryEntry{"fault", "A look-up of a page that is neither at home nor cached, and for which a request is sent."},
    GlossaryEntry{"fetch",
                  "A fault and what follows it: the request to the page's home, the reply, the installation in the cache."},
    GlossaryEntry{"film", "The picture as sums of light in integers. Films with equal hashes are equal to the last bit."},
    GlossaryEntry{"forest",
                  "The upper BVH nodes of one tree over the whole scene, which every node has; and the strategy in which nodes "
                  "ask the owners of its subtrees what a ray hits there."},
    GlossaryEntry{"frame", "A slot of a node's memory for one cached page. Of an animation: one picture."},
    GlossaryEntry{"heat map", "A picture of what each pixel cost: rays, time, faults and so on."},
    GlossaryEntry{"home", "The node that keeps a page for good and sends it on request; with --homes=host the host."},
    GlossaryEntry{"hop", "A step of a message over one link, or of a ray to another node."},
    GlossaryEntry{"host", "The one node with a large memory. It distributes the work, collects the film and ends the run."},
    GlossaryEntry{"idle at the end", "A node has nothing to do any more while other nodes still work."},
    GlossaryEntry{"instance", "One appearance of a base mesh in the scene, with its own transformation."},
    GlossaryEntry{"link", "A wire of the modelled network between two neighbours."},
    GlossaryEntry{"look-up", "A request for one record of the database, and so for the page that holds it."},
    GlossaryEntry{"lru", "Replacement policy: the page that was least recently used is evicted."},
    GlossaryEntry{"macro cell", "A cell of the grid's coarsest level; it holds a BVH."},
    GlossaryEntry{"miss",
                  "Of a page: a look-up that does not find it. Several misses that wait for one page are one fault. Of a ray: it "
                  "hits nothing."},
    GlossaryEntry{"node", "A processor with a small memory of its own, which no other can read."},
    GlossaryEntry{"overflow", "Packets of rays that go to the host because their owner has no free slot for them."},
    GlossaryEntry{
        "overhead",
        "The time in which a node does what has no price of its own: it handles requests, tokens and acknowledgements."},
    GlossaryEntry{"owner", "The node in whose region a ray is."},
    GlossaryEntry{"p95", "95 of 100 values are at most this; p50 is the median."},
    GlossaryEntry{"packet", "A message between two nodes: a short header and at most a page, or some rays."},
    GlossaryEntry{"page", "A numbered piece of the database; all have one size. Pages are what travels with svm."},
    GlossaryEntry{"pixel in flight", "A pixel that a node has begun. While it waits for a page, the node continues with others."},
    GlossaryEntry{"primary ray", "A ray from the eye through a pixel. Its hits send reflected, refracted and shadow rays."},
    GlossaryEntry{"primitive", "A triangle, sphere, cone or cylinder."},
    GlossaryEntry{
        "question",
        "With forest: what does this ray hit below that BVH node, or what is in this record? Its owner answers at once."},
    GlossaryEntry{"ray message", "A ray that one node sends to another; several share a packet."},
    GlossaryEntry{"region", "The box of space whose records a node holds (dataflow)."},
    GlossaryEntry{"replicated", "The strategy in which nothing travels: every node has the whole database."},
    GlossaryEntry{"run hash", "A digest of all events in virtual time, the machine and the film: equal runs have equal hashes."},
    GlossaryEntry{"sample", "A ray through a pixel and all rays that follow from it; a pixel is the mean of its samples."},
    GlossaryEntry{service_busy_words, "The time for which serving requests of others keeps a node from its own work."},
    GlossaryEntry{service_idle_words,
                  "The time for which a node serves requests of others while it has no work; nothing is lost by it."},
    GlossaryEntry{"shading", "Computing the light that a hit sends back, and the rays that go on from it."},
    GlossaryEntry{"slot", "Reserved space for one packet or ray; a credit is the right to use one."},
    GlossaryEntry{"speedup", "The time on one node over the time of this run."},
    GlossaryEntry{"stack distance",
                  "The number of other pages that were used since a page's last use: a cache with more frames has kept it."},
    GlossaryEntry{"starvation", "A node has no work, waits for work from others, and the run is not over."},
    GlossaryEntry{
        "submap",
        "The part of the picture that a node is given at the start; or every m-th pixel of every n-th line (--pixels)."},
    GlossaryEntry{
        "svm",
        "Shared virtual memory, the strategy in which pages travel: a node requests a page that it lacks from the page's home."},
    GlossaryEntry{"topology", "Which nodes are neighbours: mesh, hypercube, ring and so on."},
    GlossaryEntry{"virtual time", "The modelled machine's clock. It does not depend on the computer that dmpc runs on."},
    GlossaryEntry{"voxels", "A plain grid of small cells, each with a list of the primitives in it, in place of a grid of BVHs."},
    GlossaryEntry{
        "wait",
        "The time in which a node can do nothing until something arrives: a page, an answer, a ray, or room for its film "
        "at the host."},
    GlossaryEntry{"wall clock", "Time on the computer that dmpc runs on."},
    GlossaryEntry{
        "work item",
        "A square of pixels, 4x4 (3x3 where rays are traced one by one), that a node gives to one that has no work left."},
};

constexpr std::size_t line_letters_max = 100;

bool is_letter(char character) { return std::isalnum(static_cast<unsigned char>(character)) != 0; }

bool are_alike(char a, char b) {
  return std::tolower(static_cast<unsigned char>(a)) == std::tolower(static_cast<unsigned char>(b));
}

/// Nothing, or the ending of a plural, and then the word's end.
bool ends_word(std::string_view rest) {
  for (const std::string_view ending : {"es", "s", ""}) {
    if (rest.substr(0, ending.size()) == ending && (rest.size() == ending.size() || !is_letter(rest[ending.size()]))) {
      return true;
    }
  }
  return false;
}

/// "pixel in flight" has its plural in the middle.
std::string plural_of_first(std::string_view word) {
  const std::size_t space = word.find(" in ");
  return space == std::string_view::npos ? std::string(word)
                                         : std::string(word.substr(0, space)) + "s" + std::string(word.substr(space));
}

bool occurs_as(std::string_view form, std::string_view text) {
  for (auto from = text.begin();;) {
    const auto at = std::search(from, text.end(), form.begin(), form.end(), are_alike);
    if (at == text.end()) {
      return false;
    }
    const std::string_view rest = text.substr(static_cast<std::size_t>(at - text.begin()) + form.size());
    if ((at == text.begin() || !is_letter(at[-1])) && ends_word(rest)) {
      return true;
    }
    from = at + 1;
  }
}

/// The text wrapped to lines that begin with `margin`, except the first.
std::string wrapped(std::string_view text, const std::string& margin) {
  std::string lines;
  std::size_t used = margin.size();
  while (!text.empty()) {
    const std::string_view word = text.substr(0, text.find(' '));
    const bool is_full = used + 1 + word.size() > line_letters_max;
    lines += is_full ? "\n" + margin : used == margin.size() ? "" : " ";
    used = (is_full || used == margin.size() ? margin.size() : used + 1) + word.size();
    lines += word;
    text.remove_prefix(std::min(text.size(), word.size() + 1));
  }
  return lines + "\n";
}

}  // namespace

std::span<const GlossaryEntry> glossary() { return entries; }

bool occurs(std::string_view word, std::string_view text) {
  return occurs_as(word, text) || occurs_as(plural_of_first(word), text);
}

std::string glossary_text() {
  const std::size_t width =
      core::max_over(entries, std::size_t{0}, [&](const GlossaryEntry& entry) { return entry.word.size() + 2; });
  std::string text;
  for (const GlossaryEntry& entry : entries) {
    text +=
        std::string(entry.word) + std::string(width - entry.word.size(), ' ') + wrapped(entry.meaning, std::string(width, ' '));
  }
  return text;
}

}  // namespace dmpc::apps
