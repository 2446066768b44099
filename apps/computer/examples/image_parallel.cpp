// A custom strategy for rendering a scene that does not fit a node: before the start each node gets a part of the picture and the
// pages that it will use most, estimated from a small picture of its part. These pages are permanent. Any other page is requested
// from its home, used until the next one is needed, and discarded.
//
//   image_parallel --runner=virtual --machine=hdr --kept=64
//
// requests 31,789 pages and takes 19.0 ms of virtual time; with 4 pages kept 113,668 and 61.1 ms, with 256 6,066 and 5.03 ms.
// Caches with as many pages (dmpc render rings-3-t1 --resolution=64x64 --work-item=0 --in-flight=1 --cache-pages=64 and so on)
// request 13,089, 142,693 and 3,068. Result: rays move through the scene, so a part of the picture needs fewer pages at a time
// than in total, and a cache, which follows the rays, requests half as many; with hardly any memory a permanent page is at least
// not evicted before its next use. The film has the same bits.
#include <dmpc/computer.h>
#include <dmpc/scene.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <string>

enum Packets : dmpc::Index { page_request, page };
enum Operations : dmpc::Index { look_up = dmpc::scene_operation_count };  // after those of rays
enum Memory : dmpc::Index { pages_here, slots, pixel, light };

using PageNumber = std::uint32_t;
constexpr std::uint32_t nowhere = 0xffffffffU;

struct Choice {
  std::uint32_t size = 3, width = 64, kept = 64, every = 8;
};

/// Counts which pages pixels look up; all pages are present.
class Profile final : public dmpc::Pages {
 public:
  explicit Profile(const dmpc::Scene& scene) : scene_(scene), counts_(scene.page_count()) {}

  const std::byte* find(std::uint64_t offset) override {
    ++counts_[offset / scene_.page_bytes()];
    return &scene_.records()[offset];
  }
  void charge(dmpc::Index, std::uint64_t) override {}
  std::uint64_t count(PageNumber number) const { return counts_[number]; }

 private:
  const dmpc::Scene& scene_;
  std::vector<std::uint64_t> counts_;
};

/// The assignment of pixels and pages to nodes, which is fixed before the start. Immutable.
class StaticMap {
 public:
  StaticMap(const Choice& choice, std::uint32_t node_count)
      : scene_("rings-" + std::to_string(choice.size) + "-t1", choice.width, choice.width), node_count_(node_count) {
    for (std::uint32_t node = 0; node < node_count; ++node) {
      pages_.push_back(pages_of(node, choice));
      most_pages_ = std::max(most_pages_, pages_.back().size());
    }
  }

  const dmpc::Scene& scene() const { return scene_; }
  std::uint32_t home(PageNumber number) const { return number % node_count_; }
  /// Returns the first pixel of a node's part, which extends to that of the next node.
  std::uint32_t first_pixel(std::uint32_t node) const {
    return static_cast<std::uint32_t>(std::uint64_t{scene_.pixel_count()} * node / node_count_);
  }
  /// Returns the pages whose home is the node, and its permanent copies.
  const std::vector<PageNumber>& pages(std::uint32_t node) const { return pages_[node]; }

  /// Returns the bytes of the node with the most pages; the last slot is for a requested page.
  std::size_t page_bytes_here() const { return (most_pages_ + 1) * scene_.page_bytes() + dmpc::overread_bytes; }
  std::uint32_t most_pixels() const { return (scene_.pixel_count() + node_count_ - 1) / node_count_; }

 private:
  std::vector<PageNumber> pages_of(std::uint32_t node, const Choice& choice) const {
    const Profile profile = profile_of(node, choice.every);
    std::vector<PageNumber> at_home, others;
    for (PageNumber number = 0; number < scene_.page_count(); ++number) {
      (home(number) == node ? at_home : others).push_back(number);
    }
    std::stable_sort(others.begin(), others.end(),
                     [&](PageNumber a, PageNumber b) { return profile.count(a) > profile.count(b); });
    at_home.insert(at_home.end(), others.begin(), others.begin() + std::min<std::ptrdiff_t>(choice.kept, std::ssize(others)));
    return at_home;
  }

  Profile profile_of(std::uint32_t node, std::uint32_t every) const {
    Profile profile(scene_);
    dmpc::PixelTask task(scene_);
    for (std::uint32_t number = first_pixel(node); number < first_pixel(node + 1); number += every) {
      task.start(number);
      while (task.run(profile) != dmpc::Step::finished) {
      }
    }
    return profile;
  }

  dmpc::Scene scene_;
  std::uint32_t node_count_;
  std::vector<std::vector<PageNumber>> pages_;
  std::size_t most_pages_ = 0;
};

class ImageParallel final : public dmpc::Program, private dmpc::Pages {
 public:
  ImageParallel(dmpc::Node& node, const StaticMap& map)
      : node_(node),
        map_(map),
        page_bytes_(map.scene().page_bytes()),
        first_(map.first_pixel(node.id())),
        count_(map.first_pixel(node.id() + 1) - first_),
        bytes_(node.allocate<std::byte>(pages_here, map.page_bytes_here())),
        slot_of_(node.allocate<std::uint32_t>(slots, map.scene().page_count())),
        task_(map.scene(), node.allocate<std::byte>(pixel, dmpc::PixelTask::memory_bytes(map.scene()))),
        light_(node.allocate<dmpc::Light>(light, map.most_pixels())) {
    std::fill(slot_of_.begin(), slot_of_.end(), nowhere);
    for (const PageNumber number : map.pages(node.id())) {
      put(number, map.scene().records().subspan(number * page_bytes_, page_bytes_));
    }
  }

  void receive(const dmpc::Packet& packet) override {
    if (packet.kind == page_request) {
      return node_.answer(packet.source, page, bytes_of_slot(slot_of_[packet.as<PageNumber>()]));
    }
    if (passing_page_) {
      slot_of_[*passing_page_] = nowhere;
      --slot_count_;
    }
    passing_page_ = wanted_;
    put(wanted_, packet.payload);
    is_waiting_ = false;
  }

  bool work() override {
    if (is_waiting_ || finished()) {
      return false;
    }
    if (!is_under_way_) {
      task_.start(first_ + done_);
      is_under_way_ = true;
    }
    const dmpc::Step step = task_.run(*this);
    if (step == dmpc::Step::finished) {
      light_[done_++] = task_.light();
      is_under_way_ = false;
    } else if (step == dmpc::Step::absent) {
      is_waiting_ = node_.try_send(map_.home(wanted_), page_request, std::span<const PageNumber>(&wanted_, 1));
    }
    return !is_waiting_ && !finished();
  }

  bool finished() const override { return done_ == count_; }
  std::string describe() const override { return std::to_string(done_) + " pixels done"; }
  std::span<const dmpc::Light> outcome() const { return light_.first(count_); }

 private:
  const std::byte* find(std::uint64_t offset) override {
    const auto number = static_cast<PageNumber>(offset / page_bytes_);
    node_.charge(look_up);
    if (slot_of_[number] == nowhere) {
      wanted_ = number;
      return nullptr;
    }
    return &bytes_of_slot(slot_of_[number])[offset % page_bytes_];
  }
  void charge(dmpc::Index operation, std::uint64_t count) override { node_.charge(operation, count); }

  std::span<std::byte> bytes_of_slot(std::uint32_t slot) const { return bytes_.subspan(slot * page_bytes_, page_bytes_); }
  void put(PageNumber number, std::span<const std::byte> bytes) {
    slot_of_[number] = slot_count_++;
    std::copy(bytes.begin(), bytes.end(), bytes_of_slot(slot_of_[number]).begin());
  }

  dmpc::Node& node_;
  const StaticMap& map_;
  std::size_t page_bytes_;
  std::uint32_t first_, count_;  ///< the node's pixels
  std::span<std::byte> bytes_;
  std::span<std::uint32_t> slot_of_;  ///< by page
  dmpc::PixelTask task_;
  std::span<dmpc::Light> light_;  ///< results of finished pixels
  std::uint32_t slot_count_ = 0, done_ = 0;
  PageNumber wanted_ = 0;
  std::optional<PageNumber> passing_page_;  ///< in the last slot
  bool is_waiting_ = false, is_under_way_ = false;
};

int main(int count, char** words) {
  Choice choice;
  std::optional<StaticMap> map;
  const auto needs = [&](std::uint32_t nodes) -> dmpc::Needs {
    map.emplace(choice, nodes);
    std::vector<dmpc::OperationNeed> operations = dmpc::scene_operations();
    operations.push_back({"look_up", 3});
    return {.packets = {{.name = "page_request", .senders = dmpc::from_each_other()},
                        {.name = "page", .bytes_max = map->scene().page_bytes(), .answers = "page_request"}},
            .operations = operations,
            .memory = {{"pages", dmpc::bytes_of<std::byte>(map->page_bytes_here())},
                       {"slots", dmpc::bytes_of<std::uint32_t>(map->scene().page_count())},
                       {"pixel", dmpc::bytes_of<std::byte>(dmpc::PixelTask::memory_bytes(map->scene()))},
                       {"light", dmpc::bytes_of<dmpc::Light>(map->most_pixels())}}};
  };
  const auto result = [&](const std::vector<std::vector<dmpc::Light>>& of_nodes) {
    dmpc::Picture picture(map->scene());
    std::uint32_t pixel = 0;
    for (const std::vector<dmpc::Light>& of_node : of_nodes) {
      for (const dmpc::Light& light : of_node) {
        picture.put(pixel++, light);
      }
    }
    return "film " + picture.hash();
  };
  return dmpc::run<ImageParallel>(
      count, words,
      {.description = "Render a scene; each node keeps the pages that its part of the picture needs most",
       .options = {{"--size", &choice.size, 1, 6, "Size of the scene rings-SIZE-t1"},
                   {"--width", &choice.width, 1, 4096, "Side of the square picture in pixels"},
                   {"--kept", &choice.kept, 0, 1'000'000, "Pages that a node keeps in addition to those at home"},
                   {"--every", &choice.every, 1, 1'000'000, "Of so many pixels one tells which pages that are"}},
       .needs = needs,
       .make = [&map](dmpc::Node& node) { return std::make_unique<ImageParallel>(node, *map); },
       .result = result});
}
