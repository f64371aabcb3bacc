// a library has a source, also one that is of headers alone
