// Names that are given, in file names and on terminals.

#include "mortise/core/names.hpp"

#include <gmock/gmock.h>

#include "mortise/core/error.hpp"

namespace mortise {
namespace {

TEST(Names, ForFilesStayInTheirDirectory) {
  EXPECT_EQ(name_for_files("n=4, mu=0.1"), "n=4,_mu=0.1");
  EXPECT_EQ(name_for_files("../x"), "_._x");
  EXPECT_EQ(name_for_files(".."), "_.");
  EXPECT_EQ(name_for_files("."), "_");
  EXPECT_EQ(name_for_files(".mortise"), "_mortise");
  EXPECT_EQ(name_for_files("/etc/passwd"), "_etc_passwd");
  EXPECT_EQ(name_for_files("a\nb\\c$(d)\u00e4"), "a_b_c__d___");
}

TEST(Names, LongOnesForFilesAreCutAndStayDifferent) {
  const std::string fits(200, 'n'), one = std::string(5000, 'n') + "1", other = std::string(5000, 'n') + "2";
  EXPECT_EQ(name_for_files(fits), fits);
  EXPECT_EQ(name_for_files(one).size(), 200u);
  EXPECT_NE(name_for_files(one), name_for_files(other));
  EXPECT_EQ(name_for_files(name_for_files(one)), name_for_files(one));
}

TEST(Names, ControlCharactersAreShownAsQuestionMarks) {
  EXPECT_EQ(without_control_characters("a\nb\tc\x1b[2Jd\x7f"), "a?b?c?[2Jd?");
  EXPECT_EQ(without_control_characters("a\u009b2Jb\u0085"), "a?2Jb?");
  EXPECT_EQ(without_control_characters("m\u00b2 \u00e4 \u20ac"), "m\u00b2 \u00e4 \u20ac");
  EXPECT_EQ(to_string(Diagnostic{{"f", 3, "a\x1b"}, "first\nsecond \x1b"}), "f:3: error: a?: first\nsecond ?");
}

}  // namespace
}  // namespace mortise
