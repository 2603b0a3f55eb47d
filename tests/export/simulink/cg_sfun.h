/* The S-function ends with this file where it is not compiled by mex. */
