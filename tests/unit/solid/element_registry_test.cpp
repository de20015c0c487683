// Properties of every element in the registry.

#include <gtest/gtest.h>

#include <set>
#include <string>
#include <type_traits>

#include "mortise/solid/element_type.hpp"

namespace mortise {
namespace {

TEST(ElementRegistry, FindsEachElementByItsTypeAndName) {
  std::set<ElementType> types;
  std::set<std::string> names;
  visit_each_element([&](const auto& entry) {
    using Entry = std::decay_t<decltype(entry)>;
    SCOPED_TRACE(entry.name);
    EXPECT_TRUE(types.insert(entry.type).second);
    EXPECT_TRUE(names.insert(entry.name).second);
    EXPECT_NE(std::string(entry.sentence), "");
    EXPECT_EQ(to_string(entry.type), entry.name);
    EXPECT_EQ(cell_shape(entry.type), shape_of<typename Entry::Cell>);
    EXPECT_EQ(formulation(entry.type), Entry::formulation);
    EXPECT_TRUE(visit_element(entry.type, [&](const auto& found) { return static_cast<const void*>(&found) == &entry; }));
  });
  EXPECT_EQ(element_names().size(), names.size());
  EXPECT_THROW(visit_element(static_cast<ElementType>(-1), [](const auto&) {}), std::logic_error);
}

TEST(ElementRegistry, HasAStandardElementForEachCellThatHasFBar) {
  visit_each_element([](const auto& entry) {
    bool has_standard = false;
    visit_each_element([&](const auto& other) {
      has_standard = has_standard || (other.formulation == ElementFormulation::standard && cell_shape(other.type) == cell_shape(entry.type));
    });
    EXPECT_TRUE(has_standard) << entry.name;
  });
}

}  // namespace
}  // namespace mortise
