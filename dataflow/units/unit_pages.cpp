#include "dataflow/units/unit_pages.h"

#include <algorithm>

#include "core/record/choice_node.h"
#include "core/record/emitter.h"
#include "core/record/sky.h"

namespace dmpc::dataflow {

constexpr std::array<std::byte, core::record_bytes_max + core::overread_bytes> UnitPages::nothing{};

std::vector<std::uint32_t> pages_of(const core::Database& database, std::span<const core::Region> regions) {
  const core::DatabaseHeader& header = database.header();
  std::vector<bool> is_needed(database.page_count());
  const auto need = [&](core::Address address) { is_needed[core::byte_offset(address) / database.page_size()] = true; };
  core::LocalRecords records(database.bytes());
  for (const core::Region& region : regions) {
    core::for_each_record_of(records, header, region, need);
  }
  const auto need_all = [&](core::Address first, std::size_t count, std::size_t bytes) {
    for (std::size_t i = 0; i < count; ++i) {
      need(core::advance(first, i * bytes));
    }
  };
  need_all(header.lights, header.light_count, sizeof(core::LightRecord));
  need_all(header.materials, header.material_count, sizeof(core::MaterialRecord));
  if (core::has_emitters(header)) {
    need_all(header.emitters, header.emitter_count, sizeof(core::EmitterRecord));
    need_all(core::choice_address(header, 0), core::choice_node_count(header.emitter_count), sizeof(core::ChoiceNode));
  }
  if (core::has_sky_picture(header)) {
    need_all(header.sky.choices, core::choice_node_count(core::sky_tile_count(header.sky)), sizeof(core::ChoiceNode));
    need_all(header.sky.tiles, core::sky_tile_count(header.sky), sizeof(core::TextureTile));
  }
  std::vector<std::uint32_t> pages;
  for (std::uint32_t page = 0; page < is_needed.size(); ++page) {
    if (is_needed[page]) {
      pages.push_back(page);
    }
  }
  return pages;
}

bool UnitPages::add(std::uint32_t page, std::span<const std::byte> bytes) {
  core::expect(bytes.size() == page_bytes_, "a page has a page's bytes");
  if (find_page(page) != nullptr) {
    return false;
  }
  core::expect(free_frames() > 0, "a page that comes has a frame");
  std::copy(bytes.begin(), bytes.end(), bytes_.begin() + static_cast<std::ptrdiff_t>(count_ * page_bytes_));
  enter(page);
  return true;
}

void UnitPages::begin_with(std::span<const std::uint32_t> pages, const nodes::ByteSource& records) {
  core::expect(count_ == 0 && pages.size() <= page_.size(), "a node begins with its pages, each of which has a frame");
  records.copy(0, bytes_.first(records.size_bytes()));
  for (const std::uint32_t page : pages) {
    enter(page);
  }
}

/// Enters the page in the frame that holds its bytes, or will hold them.
void UnitPages::enter(std::uint32_t page) {
  const std::size_t place = place_of(page);
  page_[count_] = page;
  slot_[place] = ++count_;
}

UnitPages::Marked UnitPages::mark(const core::DatabaseHeader& header, const core::Region& region) {
  std::fill(marks_.begin(), marks_.end(), 0);
  Marked marked;
  core::for_each_record_of(*this, header, region, [&](core::Address address) {
    const auto page = static_cast<std::uint32_t>(core::byte_offset(address) / page_bytes_);
    const std::uint32_t entry = slot_[place_of(page)];
    core::expect(entry != 0, "a node has every page of its units");
    std::uint64_t& word = marks_[(entry - 1) / 64];
    const std::uint64_t bit = std::uint64_t{1} << ((entry - 1) % 64);
    ++marked.records;
    marked.pages += (word & bit) == 0 ? 1 : 0;
    word |= bit;
  });
  return marked;
}

std::uint32_t UnitPages::next_marked(std::uint32_t from) const {
  while ((marks_[from / 64] >> (from % 64) & 1U) == 0) {
    ++from;
    core::expect(from < count_, "a page that is asked for is marked");
  }
  return from;
}

}  // namespace dmpc::dataflow
