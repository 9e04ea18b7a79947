# cmake -DINPUT=a.ll -DOUTPUT=b.ll -P strip_target.cmake
# Takes from the library's IR what ties it to one processor: function attributes for processor, features and vector
# width, which the code generator sets for the whole program, and module flags. Triple and data layout stay; who links
# for another machine sets his own on the loaded module.
file(READ ${INPUT} text)
foreach(attribute target-cpu target-features tune-cpu min-legal-vector-width frame-pointer no-trapping-math
                  stack-protector-buffer-size)
  string(REGEX REPLACE " \"${attribute}\"=\"[^\"]*\"" "" text "${text}")
endforeach()
string(REGEX REPLACE "\n!llvm.(module.flags|ident) = [^\n]*" "" text "${text}")
file(WRITE ${OUTPUT} "${text}")
