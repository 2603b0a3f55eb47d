// The fixed parts of exported models, one text a language and subject; embedded at build time from src/export/runtime.
#pragma once

#include <string_view>

namespace hysteron::runtime {

std::string_view header_h();
std::string_view march_c();
std::string_view chain_c();
std::string_view chain_force_c();
std::string_view series_c();
std::string_view drive_c();
std::string_view step_c();
std::string_view test_c();
std::string_view fmi2_h();
std::string_view fmu_c();
std::string_view simulink_c();
std::string_view modelica_h();
std::string_view modelica_mo();
std::string_view python_py();
std::string_view python_test_py();

}  // namespace hysteron::runtime
