#include "apps/show/page/pictures.h"

#include <doctest/doctest.h>

#include <cstddef>
#include <sstream>

#include "tests/support/text.h"

namespace dmpc::apps::html::pictures_test {

using tests::contains;

namespace {

/// A page with a picture.
std::string page_of(const Image& image, const std::string& description, const std::string& caption) {
  Page page("Picture");
  add_picture(page, image, description, caption);
  return page.text();
}

}  // namespace

TEST_CASE("a picture is a PNG within its own address") {
  CHECK(picture_url(Image(2, 3)).rfind("data:image/png;base64,iVBORw0KGgo", 0) == 0);  // the eight bytes with which a PNG begins
}

TEST_CASE("what a picture shows is told as it is to those who do not see it") {
  const std::string text = page_of(Image(1, 1), "a \"picture\"", "<i>");
  CHECK(contains(text, "alt=\"a &quot;picture&quot;\""));
  CHECK(contains(text, "<figcaption>&lt;i&gt; <a "));
}

TEST_CASE("a page says that it shows a picture smaller than it is") {
  const auto with_side = [](int side) { return page_of(Image(side, 1), "", "Black."); };
  CHECK(contains(with_side(1024), "width=\"1024\" height=\"1\""));
  CHECK(contains(with_side(1025), "width=\"513\" height=\"1\""));
  CHECK(contains(with_side(1025), "Black. Shown smaller than it is: 1025x1 pixels."));
}

TEST_CASE("a picture can be saved whole and without a script") {
  CHECK(contains(page_of(Image(1025, 1), "The picture of <x>", "Black."),
                 "href=\"" + picture_url(Image(1025, 1)) + "\" download=\"the-picture-of-x.png\""));
}

TEST_CASE("a picture that is shown whole is in the page once") {
  const std::string text = page_of(Image(5, 3), "x", "Black."), url = picture_url(Image(5, 3));
  CHECK(text.find(url) != std::string::npos);
  CHECK(text.find(url) == text.rfind(url));
  CHECK(contains(text, "hidden data-name=\"x.png\""));
}

}  // namespace dmpc::apps::html::pictures_test
