// Names that exported code can have in every language it is written in.
#include "export/names.hpp"

#include <gtest/gtest.h>

#include "core/error.hpp"

namespace hysteron {
namespace {

std::string refusal_of(const std::string& name, Option option = Option::name) {
  try {
    refuse_name(option, name);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(ExportNames, AreIdentifiers) {
  for (const char* name : {"damper", "Damper_2", "bouc_wen", "classes", "m_class"}) EXPECT_EQ(refusal_of(name), "");
  for (const char* name : {"", "2nd", "bouc-wen", "a b", "_damper", "_math", "d\xc3\xa4mpfer"}) {
    EXPECT_NE(refusal_of(name).find("is not an identifier"), std::string::npos) << name;
  }
  EXPECT_EQ(identifier("bouc-wen"), "bouc_wen");
  EXPECT_EQ(identifier("2nd"), "m_2nd");
  EXPECT_EQ(identifier("-"), "m__");
}

TEST(ExportNames, AreNoWordsOfTheLanguages) {
  EXPECT_EQ(refusal_of("class"), "name: 'class' is a word of C++, Python and Modelica, expected another name");
  EXPECT_EQ(refusal_of("lambda"), "name: 'lambda' is a word of Python, expected another name");
  EXPECT_EQ(refusal_of("int"), "name: 'int' is a word of C and C++, expected another name");
  EXPECT_EQ(refusal_of("model", Option::out), "out: 'model' is a word of Modelica, expected another file or name NAME");
  // The module itself imports it, and the FMU has a source file of its own by that name.
  for (const char* name : {"math", "sys", "fmu"}) {
    EXPECT_NE(refusal_of(name).find("is a file or module that exported code uses"), std::string::npos) << name;
  }
}

}  // namespace
}  // namespace hysteron
