/* Words that the core may not contain. */
#pragma GCC poison float double malloc calloc realloc free alloca printf setjmp
