# Makes Doxygen's comments of the headers' own: the first one is that of the file, in C++ those on lines
# of their own belong to what follows, those behind code to what stands before.
1s|^/\*$|/** @file|
1s|^// |/// @file\n/// |
s|^\( *\)//$|\1///|
s|^\( *\)// |\1/// |
s|\([;,{]\)  *// |\1  ///< |
# These share the comment above them.
s|^#define NM_VERSION_MINOR .*|&  ///< See NM_VERSION_MAJOR.|
s|^#define NM_VERSION_PATCH .*|&  ///< See NM_VERSION_MAJOR.|
s|^#define NM_MAX_DIM .*|&  ///< See NM_MIN_DIM.|
