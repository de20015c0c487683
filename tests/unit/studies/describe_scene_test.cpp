#include "mortise/studies/describe_scene.hpp"

#include <gtest/gtest.h>

#include "mortise/core/error.hpp"

namespace mortise {
namespace {

TEST(DescribeScene, EveryListHasItsPage) {
  const auto pages = reference_pages();
  ASSERT_GT(pages.size(), 10u);
  for (const auto& page : pages) EXPECT_FALSE(page.content.empty()) << page.file;
  for (const auto& topic : choice_topics()) EXPECT_FALSE(list_choices(topic).empty()) << topic;
  EXPECT_THROW(list_choices("animals"), InputError);
}

}  // namespace
}  // namespace mortise
