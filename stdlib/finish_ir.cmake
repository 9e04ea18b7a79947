# cmake -DINPUT=a.ll -DOUTPUT=b.ll -DWIDTH=16 -P finish_ir.cmake
# Takes from the library's IR what ties it to one processor: function attributes for processor, features and vector
# width, which the code generator sets for the whole program, and module flags. Triple and data layout stay; who links
# for another machine sets his own on the loaded module. Adds the definitions of gathers and tables (gather.ll.in).
cmake_minimum_required(VERSION 3.25)
file(READ ${INPUT} text)
foreach(attribute target-cpu target-features tune-cpu min-legal-vector-width frame-pointer no-trapping-math
                  stack-protector-buffer-size)
  string(REGEX REPLACE " \"${attribute}\"=\"[^\"]*\"" "" text "${text}")
endforeach()
string(REGEX REPLACE "\n!llvm.(module.flags|ident) = [^\n]*" "" text "${text}")
# What C++ cannot say of the externals of many lanes (externals.h): calls whose result is not used may go.
set(given "ptr nocapture readonly")
set(pure "nounwind willreturn memory(argmem: readwrite)")
string(REGEX REPLACE "\ndeclare void @(moonshade_[a-z0-9_]*_lanes)\\(ptr [^,]*, ptr [^,]*, i32 [^\n]*"
       "\ndeclare void @\\1(ptr nocapture writeonly, ${given}, i32) ${pure}" text "${text}")
string(REGEX REPLACE "\ndeclare void @(moonshade_[a-z0-9_]*_lanes)\\(ptr [^,]*, ptr [^,]*, ptr [^,]*, i32 [^\n]*"
       "\ndeclare void @\\1(ptr nocapture writeonly, ${given}, ${given}, i32) ${pure}" text "${text}")
if(WIDTH GREATER 1)
  string(REGEX REPLACE "\ndeclare [a-z0-9 ]*@moonshade_(gather_w|table_of|target_has)[^\n]*" "" text "${text}")
  file(READ ${CMAKE_CURRENT_LIST_DIR}/gather.ll.in gather)
  string(REPLACE "@WIDTH@" "${WIDTH}" gather "${gather}")
  string(APPEND text "${gather}")
endif()
file(WRITE ${OUTPUT} "${text}")
