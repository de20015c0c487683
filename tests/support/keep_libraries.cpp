#include "keep_libraries.hpp"
