// What the common subset of GLSL 4.50 and C++ needs to be spelled differently in the two languages.
// core/math/Shading.h defines the C++ side before it includes these files.
//
// The subset: no swizzle writes (single components are fine), no implicit conversions, an `f` on
// every float, no array constructors, no recursion, quoted includes relative to the including file.
#ifndef PT_MACROS_GLSL
#define PT_MACROS_GLSL

#ifndef PT_CPP
#define PT_FN                                        // before every function
#define PT_CONST const                               // before every constant
#define PT_OUT(type) out type                        // parameter that is written
#define PT_INOUT(type) inout type                    // parameter that is changed
#define PT_ARRAY(type, name, n) type name[n]         // parameter: array that is read
#define PT_OUT_ARRAY(type, name, n) out type name[n] // parameter: array that is written
#define PT_INOUT_ARRAY(type, name, n) inout type name[n] // parameter: array that is changed
#define PT_INIT(value)                               // default of a structure's member, in C++ only
#define PT_EQUALITY(type)                            // in a structure: C++ compares it by members
#endif

#endif
