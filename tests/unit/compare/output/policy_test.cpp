// SPDX-License-Identifier: MIT
// The content security policy of a report's page.
#include "compare/output/policy.h"

#include <gtest/gtest.h>

#include <string>

namespace diptych {
namespace {

// Examples of FIPS 180-4, and lengths around the ends of blocks (Python's hashlib).
TEST(PagePolicy, AScriptIsCalledByItsHash) {
    EXPECT_EQ(scriptSource(""), "'sha256-47DEQpj8HBSa+/TImW+5JCeuQeRkm5NMpJWZG3hSuFU='");
    EXPECT_EQ(scriptSource("abc"), "'sha256-ungWv48Bz+pBQUDeXa4iI7ADYaOWF3qctBD/YfIAFa0='");
    EXPECT_EQ(scriptSource(std::string(55, 'a')), "'sha256-n0OQ+NMMLdkuyfCVtl4rmumwqSWlJY4kHJ8ekQ9zQxg='");
    EXPECT_EQ(scriptSource(std::string(56, 'a')), "'sha256-s1Q5pKxvCUi21vnjxq8PX1kM4g8b3nCQ73lwaG7Gc4o='");
    EXPECT_EQ(scriptSource(std::string(64, 'a')), "'sha256-/+BU/nrgy23GXDr5th1SCfQ5hR20PQulmXM33xVGaOs='");
    EXPECT_EQ(scriptSource(std::string(119, 'a')), "'sha256-MeulHDE6XAgiat8Y1KNZz9/Y0ugWsT9K+VL36mWE3Ps='");
    EXPECT_EQ(scriptSource(std::string(1000000, 'a')),
              "'sha256-zcduXJkU+5KBocfihNc+Z/GAmkiklyAOBG05zMcRLNA='");
}

TEST(PagePolicy, DataIsOneCallWithJson) {
    for (const char* data : {"diptychSection(\"a.js\",\"<b>);\\n</b>\");\n", "diptychSection(3,\"\");\n",
                             "diptychValues(\"a\",{\"width\":2,\"data\":[\"x\"]});\n"})
        EXPECT_TRUE(isDataScript(data)) << data;
    for (const char* code :
         {"", "alert(1);\n", "diptychSection(alert(1),\"\");\n", "diptychSection(1,\"\");alert(1);\n",
          "diptychSection(1,\"\");alert(\"\");\n", "diptychSection(1,`${alert(1)}`);\n",
          "diptychSection(1,\"\"/**/);\n", "alert(1);diptychSection(1,\"\");\n", "diptychSection(1,\"\")",
          "diptychSection(", "diptychSection(1)];[(2);\n", "diptychOther(1);\n", "diptychValues(x=1);\n"})
        EXPECT_FALSE(isDataScript(code)) << code;
}

}  // namespace
}  // namespace diptych
