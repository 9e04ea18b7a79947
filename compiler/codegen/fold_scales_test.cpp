// fold_scales: functions of LLVM's before and after, as text.
#include "compiler/codegen/fold_scales.h"

#include "compiler/codegen/llvm_text_for_test.h"

#include <gtest/gtest.h>
#include <regex>

namespace moonshade::codegen {
namespace {

/// The function `f` with these instructions, which begin with the integers %n of at most 24 bits, after folding.
std::string after(const std::string& instructions) {
  const std::string before = "define <2 x float> @f(<2 x i32> %x, <2 x float> %y) {\n"
                             "  %n = lshr <2 x i32> %x, <i32 8, i32 8>\n";
  const std::string text = function_after(before + instructions +
                                              "}\ndeclare <2 x float> @llvm.fma.v2f32("
                                              "<2 x float>, <2 x float>, <2 x float>)\n",
                                          fold_scales);
  return text.starts_with(before) ? text.substr(before.size(), text.size() - before.size() - 2) : text;
}

/// As LLVM prints what may be written shorter.
std::string printed(const std::string& instructions) {
  return std::regex_replace(instructions, std::regex(R"(splat \(float ([^)]*)\))"), "<float $1, float $1>");
}

void expect_folded(const std::string& instructions, const std::string& expected) {
  EXPECT_EQ(after(instructions), printed(expected));
}
void expect_kept(const std::string& instructions) { expect_folded(instructions, instructions); }

TEST(FoldScales, ConstantsTakeThePowerOfTwo) {
  expect_folded(
      "  %f = uitofp <2 x i32> %n to <2 x float>\n"
      "  %h = fmul <2 x float> %f, splat (float 0x3E70000000000000)\n"
      "  %a = call <2 x float> @llvm.fma.v2f32(<2 x float> %h, <2 x float> splat (float 3.0), <2 x float> %y)\n"
      "  %b = call <2 x float> @llvm.fma.v2f32(<2 x float> splat (float 5.0), <2 x float> %h, <2 x float> %a)\n"
      "  %c = fmul <2 x float> %h, splat (float -7.0)\n"
      "  %d = fadd <2 x float> %b, %c\n"
      "  ret <2 x float> %d\n",
      "  %f = uitofp <2 x i32> %n to <2 x float>\n"
      "  %a = call <2 x float> @llvm.fma.v2f32(<2 x float> %f, <2 x float> splat (float 0x3E88000000000000), <2 x "
      "float> %y)\n"
      "  %b = call <2 x float> @llvm.fma.v2f32(<2 x float> splat (float 0x3E94000000000000), <2 x float> %f, <2 x "
      "float> %a)\n"
      "  %c = fmul <2 x float> %f, splat (float 0xBE9C000000000000)\n"
      "  %d = fadd <2 x float> %b, %c\n"
      "  ret <2 x float> %d\n");
}

TEST(FoldScales, SignedConversionsOfWhatIsPositiveCountToo) {
  expect_folded("  %f = sitofp <2 x i32> %n to <2 x float>\n"
                "  %h = fmul <2 x float> %f, splat (float 5.0e-01)\n"
                "  %c = fmul <2 x float> %h, splat (float 3.0)\n"
                "  ret <2 x float> %c\n",
                "  %f = sitofp <2 x i32> %n to <2 x float>\n"
                "  %c = fmul <2 x float> %f, splat (float 1.500000e+00)\n"
                "  ret <2 x float> %c\n");
}

TEST(FoldScales, WhatWouldRoundOtherwiseStays) {
  // Numbers that the conversion rounds; a factor that is no power of two; one that underflows.
  expect_kept("  %f = uitofp <2 x i32> %x to <2 x float>\n"
              "  %h = fmul <2 x float> %f, splat (float 5.000000e-01)\n"
              "  %c = fmul <2 x float> %h, splat (float 3.000000e+00)\n"
              "  ret <2 x float> %c\n");
  expect_kept("  %f = uitofp <2 x i32> %n to <2 x float>\n"
              "  %h = fmul <2 x float> %f, splat (float 7.500000e-01)\n"
              "  %c = fmul <2 x float> %h, splat (float 3.000000e+00)\n"
              "  ret <2 x float> %c\n");
  expect_kept("  %f = uitofp <2 x i32> %n to <2 x float>\n"
              "  %h = fmul <2 x float> %f, splat (float 0x3E70000000000000)\n"
              "  %c = fmul <2 x float> %h, splat (float 0x3980000000000000)\n"
              "  ret <2 x float> %c\n");
}

TEST(FoldScales, WhatIsWantedAsANumberStays) {
  // As an addend; beside no constant; once with a constant and once without.
  expect_kept("  %f = uitofp <2 x i32> %n to <2 x float>\n"
              "  %h = fmul <2 x float> %f, splat (float 5.000000e-01)\n"
              "  %c = call <2 x float> @llvm.fma.v2f32(<2 x float> %y, <2 x float> splat (float 3.000000e+00), <2 x "
              "float> %h)\n"
              "  ret <2 x float> %c\n");
  expect_kept("  %f = uitofp <2 x i32> %n to <2 x float>\n"
              "  %h = fmul <2 x float> %f, splat (float 5.000000e-01)\n"
              "  %c = fmul <2 x float> %h, %h\n"
              "  ret <2 x float> %c\n");
  expect_kept("  %f = uitofp <2 x i32> %n to <2 x float>\n"
              "  %h = fmul <2 x float> %f, splat (float 5.000000e-01)\n"
              "  %c = fmul <2 x float> %h, splat (float 3.000000e+00)\n"
              "  %d = fmul <2 x float> %h, %c\n"
              "  ret <2 x float> %d\n");
}

} // namespace
} // namespace moonshade::codegen
