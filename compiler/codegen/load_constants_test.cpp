// load_constants: functions of LLVM's before and after, as text.
#include "compiler/codegen/load_constants.h"

#include "compiler/codegen/llvm_text_for_test.h"

#include <gtest/gtest.h>

namespace moonshade::codegen {
namespace {

TEST(LoadConstants, OnceABlockAndOnceInMemory) {
  const std::string before = "define <2 x float> @f(<2 x float> %x, i1 %c) {\n"
                             "  %a = fmul <2 x float> %x, <float 3.000000e+00, float 4.000000e+00>\n"
                             "  %b = fadd <2 x float> <float 3.000000e+00, float 4.000000e+00>, %a\n"
                             "  br i1 %c, label %then, label %end\n\n"
                             "then:\n"
                             "  %d = fadd <2 x float> %b, <float 3.000000e+00, float 4.000000e+00>\n"
                             "  br label %end\n\n"
                             "end:\n"
                             "  %r = phi <2 x float> [ %d, %then ], [ %b, %0 ]\n"
                             "  ret <2 x float> %r\n"
                             "}\n";
  EXPECT_EQ(function_after(before, load_constants),
            "define <2 x float> @f(<2 x float> %x, i1 %c) {\n"
            "  %1 = load <2 x float>, ptr @0, align 8\n"
            "  %a = fmul <2 x float> %x, %1\n"
            "  %b = fadd <2 x float> %1, %a\n"
            "  br i1 %c, label %then, label %end\n\n"
            "then:                                             ; preds = %0\n"
            "  %2 = load <2 x float>, ptr @0, align 8\n"
            "  %d = fadd <2 x float> %b, %2\n"
            "  br label %end\n\n"
            "end:                                              ; preds = %then, %0\n"
            "  %r = phi <2 x float> [ %d, %then ], [ %b, %0 ]\n"
            "  ret <2 x float> %r\n"
            "}\n");
}

TEST(LoadConstants, LeavesZerosIntegersAndPhis) {
  const std::string text = "define <2 x float> @f(<2 x float> %x, <2 x i32> %n, i1 %c) {\n"
                           "  %a = fadd <2 x float> %x, zeroinitializer\n"
                           "  %s = shl <2 x i32> %n, <i32 3, i32 4>\n"
                           "  %b = bitcast <2 x i32> %s to <2 x float>\n"
                           "  br i1 %c, label %then, label %end\n\n"
                           "then:                                             ; preds = %0\n"
                           "  br label %end\n\n"
                           "end:                                              ; preds = %then, %0\n"
                           "  %r = phi <2 x float> [ <float 1.000000e+00, float 2.000000e+00>, %then ], [ %b, %0 ]\n"
                           "  ret <2 x float> %r\n"
                           "}\n";
  EXPECT_EQ(function_after(text, load_constants), text);
}

} // namespace
} // namespace moonshade::codegen
