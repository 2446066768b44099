#include "apps/frontend/line/amount.h"

#include <doctest/doctest.h>

#include <string>

namespace dmpc::apps::amount_test {

namespace {

std::string tick_texts(double least, double largest, bool is_logarithmic, std::string_view unit) {
  std::string text;
  for (const Tick& tick : amount_ticks(least, largest, is_logarithmic, unit)) {
    text += (text.empty() ? "" : " | ") + tick.text;
  }
  return text;
}

}  // namespace

TEST_CASE("an amount has the unit in which it is short") {
  CHECK(amount_text(105e6, "bytes") == "105 MB");
  CHECK(amount_text(64, "bytes") == "64 B");
  CHECK(amount_text(1'439'076, "bytes") == "1.44 MB");
  CHECK(amount_text(0, "bytes") == "0 B");
  CHECK(amount_text(2.5e6, "ns") == "2.50 ms");
  CHECK(amount_text(0.25, "s") == "250 ms");
  CHECK(amount_text(2048, "KiB") == "2.00 MiB");
  CHECK(amount_text(1'234'567, "rays") == "1,234,567 rays");
  CHECK(amount_text(1'234'567, "") == "1,234,567");
  CHECK(amount_text(0.035, "") == "0.035");
}

TEST_CASE("ticks are round in the unit that they name") {
  CHECK(tick_texts(0, 105e6, false, "bytes") == "0 | 20 MB | 40 MB | 60 MB | 80 MB | 100 MB");
  CHECK(tick_texts(0, 2300, false, "us") == "0 | 0.5 ms | 1 ms | 1.5 ms | 2 ms");
  CHECK(tick_texts(0, 20480, false, "KiB") == "0 | 5 MiB | 10 MiB | 15 MiB | 20 MiB");
  CHECK(tick_texts(0, 25'000, false, "") == "0 | 5,000 | 10,000 | 15,000 | 20,000 | 25,000");
  CHECK(tick_texts(1e4, 1e8, true, "bytes") == "10 KB | 100 KB | 1 MB | 10 MB | 100 MB");
  CHECK(tick_texts(0, 100, false, "%") == "0 | 20 | 40 | 60 | 80 | 100");
}

TEST_CASE("the place of a tick is in the unit that was counted in") {
  CHECK(amount_ticks(0, 20480, false, "KiB")[1].position == 5120);
  CHECK(amount_ticks(0, 0, false, "bytes").size() == 1);
}

}  // namespace dmpc::apps::amount_test
