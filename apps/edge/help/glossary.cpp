#include "apps/edge/help/glossary.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>

namespace dmpc::apps {

namespace {

constexpr std::array entries = {
    GlossaryEntry{"asleep", "Of a node: it has nothing to do until a packet comes."},
    GlossaryEntry{"backlog", "Rays that a node has taken up and not finished."},
    GlossaryEntry{"cache", "A node's places for pages whose home is another node."},
    GlossaryEntry{"chaos",
                  "A seed disturbs the computer: packets are held back, nodes pause, credits shrink. The film stays the same."},
    GlossaryEntry{"computing", "Time in which a node traces and shades rays."},
    GlossaryEntry{"convention",
                  "When shadow rays are shot: towards lights that the surface faces (haines), or towards all (paper, as the "
                  "article of 1994 counts)."},
    GlossaryEntry{"coplanar faces",
                  "Triangles that cover each other in one plane: the first in the scene's file shows, but what lets light "
                  "through lies behind the others."},
    GlossaryEntry{"credit",
                  "The right to send one more packet or to start one more ray; it comes back when there is room again."},
    GlossaryEntry{"crossbar", "A network in which each node has a link of its own to every other."},
    GlossaryEntry{"cutoff", "Rays that could bring less light than this are not shot."},
    GlossaryEntry{"database", "The scene as flat records (grid, primitives, shading data, materials, lights), cut into pages."},
    GlossaryEntry{"dataflow", "The strategy by which rays travel: each node holds a region of space, and rays go to its owner."},
    GlossaryEntry{"eviction", "A cached page gives its place to another."},
    GlossaryEntry{"extents", "Boxes in boxes: one tree of bricks over the whole scene, in place of a grid of trees."},
    GlossaryEntry{"fault", "A look-up of a page that is neither at home nor cached, and for which a request is sent."},
    GlossaryEntry{"fetch",
                  "A fault and what follows it: the request to the page's home, the reply, the page taken into the cache."},
    GlossaryEntry{"film",
                  "The picture as sums of light in whole numbers. Equal hashes of films mean equal pictures, to the last bit."},
    GlossaryEntry{"forest",
                  "The upper bricks of one tree over the whole scene, which every node has; and the strategy by which nodes ask "
                  "the owners of its subtrees what rays meet there."},
    GlossaryEntry{"heat map", "A picture of what each pixel took: rays, time, faults and so on."},
    GlossaryEntry{"home", "The node, or with --homes=host the host, that keeps a page for good and sends it to those who ask."},
    GlossaryEntry{"hop", "A step of a message over one link, or of a ray to another node."},
    GlossaryEntry{"host", "The one node with a large memory: it deals out the picture, collects it and ends the run."},
    GlossaryEntry{"idle at the end", "A node has nothing to do any more, and others have."},
    GlossaryEntry{"lent",
                  "Time for which a node serves others' requests while it has nothing else to do: nothing is lost by it."},
    GlossaryEntry{"link", "A wire of the modelled network, between two neighbours."},
    GlossaryEntry{"look-up", "The question for one record of the database, and so for the page that it lies in."},
    GlossaryEntry{"lru", "The page leaves that was used least recently."},
    GlossaryEntry{"miss",
                  "Of a page: a look-up that does not find it. Several misses that wait for one page are one fault. Of a "
                  "ray: it hits nothing."},
    GlossaryEntry{"node", "A processor with a small memory of its own, which no other can read."},
    GlossaryEntry{"overflow", "Packets of rays that go to the host, since their owner has no room for them."},
    GlossaryEntry{"owner", "The node in whose region a ray is."},
    GlossaryEntry{"p95", "As long as that or shorter are 95 of 100; p50 is the median."},
    GlossaryEntry{"packet", "What a node sends to another at once: a short head and at most a page, or some rays."},
    GlossaryEntry{"page", "A numbered piece of the database, all of one size; what travels by svm."},
    GlossaryEntry{"pixel in flight", "A pixel that a node has begun; while it waits for a page, the node goes on with others."},
    GlossaryEntry{"primary ray", "A ray from the eye through a pixel. From its hits come reflected, refracted and shadow rays."},
    GlossaryEntry{"primitive", "A triangle, sphere, cone or cylinder."},
    GlossaryEntry{"question",
                  "By forest: what does this ray meet below that brick, or what is in this record. Its owner answers at once."},
    GlossaryEntry{"ray message", "A ray that one node sends to another; some of them share a packet."},
    GlossaryEntry{"region", "The box of space whose records a node holds, by dataflow."},
    GlossaryEntry{"replicated", "The strategy by which nothing travels: every node has the whole database."},
    GlossaryEntry{"run hash", "A digest of all events in virtual time, the machine and the film: equal runs have equal hashes."},
    GlossaryEntry{"sample", "A ray through a pixel and all that comes of it; a pixel is the mean of its samples."},
    GlossaryEntry{"shading", "Finding the light that a hit sends back, and the rays that go on from it."},
    GlossaryEntry{"speedup", "How many times shorter the run is than on one node."},
    GlossaryEntry{"stack distance",
                  "How many other pages were used since a page's last use: a cache of more places has kept it."},
    GlossaryEntry{"stolen", "Time for which serving others' requests keeps a node from work of its own."},
    GlossaryEntry{
        "submap",
        "The part of the picture that a node is given at the start; or every m-th pixel of every n-th line (--pixels)."},
    GlossaryEntry{"svm", "Shared virtual memory, the strategy by which pages travel: a node asks the home for a page it lacks."},
    GlossaryEntry{"top cell", "A cell of the grid's coarsest level, which holds a tree of bricks: boxes of primitives."},
    GlossaryEntry{"topology", "Which nodes are neighbours: mesh, hypercube, ring and so on."},
    GlossaryEntry{"virtual time", "The modelled machine's clock. It does not depend on the computer that dmpc runs on."},
    GlossaryEntry{"voxels", "A plain grid of small cells, each with a list of what lies in it, in place of a grid of trees."},
    GlossaryEntry{"wall clock", "Time on the computer that dmpc runs on."},
    GlossaryEntry{"work item",
                  "A square of pixels, 4x4 (3x3 where rays walk alone), that a node hands to one that has run out of work."},
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

/// Its words on lines that begin with `margin`, but for the first.
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
  std::size_t width = 0;
  for (const GlossaryEntry& entry : entries) {
    width = std::max(width, entry.word.size() + 2);
  }
  std::string text;
  for (const GlossaryEntry& entry : entries) {
    text +=
        std::string(entry.word) + std::string(width - entry.word.size(), ' ') + wrapped(entry.meaning, std::string(width, ' '));
  }
  return text;
}

}  // namespace dmpc::apps
