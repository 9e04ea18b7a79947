// split_lanes: functions of LLVM's before and after, as text.
#include "compiler/codegen/split_lanes.h"

#include "compiler/codegen/llvm_text_for_test.h"

#include <gtest/gtest.h>

namespace moonshade::codegen {
namespace {

/// The function `f` of the text, split from four lanes to halves of two.
std::string after(const std::string& text) {
  return "\n" + function_after(text, [](llvm::Module& module) { split_lanes(module, 4, 2); });
}

TEST(SplitLanes, WhatWorksByLaneIsDoneForEachHalf) {
  EXPECT_EQ(after(R"(
define void @f(ptr %p, float %x) {
  %v = load <4 x float>, ptr %p, align 4
  %i = insertelement <4 x float> poison, float %x, i64 0
  %s = shufflevector <4 x float> %i, <4 x float> poison, <4 x i32> zeroinitializer
  %m = fcmp ole <4 x float> %v, %s
  %r = select <4 x i1> %m, <4 x float> %v, <4 x float> <float 1.0, float 2.0, float 3.0, float 4.0>
  %q = call <4 x float> @llvm.fma.v4f32(<4 x float> %r, <4 x float> %v, <4 x float> zeroinitializer)
  store <4 x float> %q, ptr %p, align 4
  ret void
}
declare <4 x float> @llvm.fma.v4f32(<4 x float>, <4 x float>, <4 x float>)
)"),
            R"(
define void @f(ptr %p, float %x) {
  %1 = load <2 x float>, ptr %p, align 4
  %2 = getelementptr inbounds i8, ptr %p, i64 8
  %3 = load <2 x float>, ptr %2, align 4
  %.splatinsert = insertelement <2 x float> poison, float %x, i64 0
  %.splat = shufflevector <2 x float> %.splatinsert, <2 x float> poison, <2 x i32> zeroinitializer
  %4 = fcmp ole <2 x float> %1, %.splat
  %5 = fcmp ole <2 x float> %3, %.splat
  %6 = select <2 x i1> %4, <2 x float> %1, <2 x float> <float 1.000000e+00, float 2.000000e+00>
  %7 = select <2 x i1> %5, <2 x float> %3, <2 x float> <float 3.000000e+00, float 4.000000e+00>
  %8 = call <2 x float> @llvm.fma.v2f32(<2 x float> %6, <2 x float> %1, <2 x float> zeroinitializer)
  %9 = call <2 x float> @llvm.fma.v2f32(<2 x float> %7, <2 x float> %3, <2 x float> zeroinitializer)
  store <2 x float> %8, ptr %p, align 4
  %10 = getelementptr inbounds i8, ptr %p, i64 8
  store <2 x float> %9, ptr %10, align 4
  ret void
}
)");
}

TEST(SplitLanes, AMaskIsCarriedThroughALoopInHalves) {
  EXPECT_EQ(after(R"(
define void @f(ptr %p) {
entry:
  br label %loop
loop:
  %mask = phi <4 x i1> [ <i1 true, i1 true, i1 true, i1 true>, %entry ], [ %left, %loop ]
  %v = load <4 x i32>, ptr %p, align 4
  %c = icmp slt <4 x i32> %v, zeroinitializer
  %left = and <4 x i1> %mask, %c
  %bits = bitcast <4 x i1> %left to i4
  %none = icmp eq i4 %bits, 0
  br i1 %none, label %end, label %loop
end:
  ret void
}
)"),
            R"(
define void @f(ptr %p) {
entry:
  br label %loop

loop:                                             ; preds = %loop, %entry
  %mask1 = phi <2 x i1> [ <i1 true, i1 true>, %entry ], [ %5, %loop ]
  %mask2 = phi <2 x i1> [ <i1 true, i1 true>, %entry ], [ %6, %loop ]
  %0 = load <2 x i32>, ptr %p, align 4
  %1 = getelementptr inbounds i8, ptr %p, i64 8
  %2 = load <2 x i32>, ptr %1, align 4
  %3 = icmp slt <2 x i32> %0, zeroinitializer
  %4 = icmp slt <2 x i32> %2, zeroinitializer
  %5 = and <2 x i1> %mask1, %3
  %6 = and <2 x i1> %mask2, %4
  %7 = or <2 x i1> %5, %6
  %8 = bitcast <2 x i1> %7 to i2
  %9 = icmp eq i2 %8, 0
  br i1 %9, label %end, label %loop

end:                                              ; preds = %loop
  ret void
}
)");
}

TEST(SplitLanes, CallsAndShufflesWorkOnTheWhole) {
  EXPECT_EQ(after(R"(
define <4 x float> @f(<4 x float> %v) {
  %s = fadd <4 x float> %v, %v
  %r = shufflevector <4 x float> %s, <4 x float> poison, <4 x i32> <i32 3, i32 2, i32 1, i32 0>
  %q = call <4 x float> @g(<4 x float> %r)
  %t = fmul <4 x float> %q, %s
  ret <4 x float> %t
}
declare <4 x float> @g(<4 x float>)
)"),
            R"(
define <4 x float> @f(<4 x float> %v) {
  %1 = shufflevector <4 x float> %v, <4 x float> poison, <2 x i32> <i32 0, i32 1>
  %2 = shufflevector <4 x float> %v, <4 x float> poison, <2 x i32> <i32 2, i32 3>
  %3 = fadd <2 x float> %1, %1
  %4 = fadd <2 x float> %2, %2
  %5 = shufflevector <2 x float> %3, <2 x float> %4, <4 x i32> <i32 0, i32 1, i32 2, i32 3>
  %r = shufflevector <4 x float> %5, <4 x float> poison, <4 x i32> <i32 3, i32 2, i32 1, i32 0>
  %q = call <4 x float> @g(<4 x float> %r)
  %6 = shufflevector <4 x float> %q, <4 x float> poison, <2 x i32> <i32 0, i32 1>
  %7 = shufflevector <4 x float> %q, <4 x float> poison, <2 x i32> <i32 2, i32 3>
  %8 = fmul <2 x float> %6, %3
  %9 = fmul <2 x float> %7, %4
  %10 = shufflevector <2 x float> %8, <2 x float> %9, <4 x i32> <i32 0, i32 1, i32 2, i32 3>
  ret <4 x float> %10
}
)");
}

} // namespace
} // namespace moonshade::codegen
