"""HTTP: parse, call one use case, answer. No SQL, no image processing, no decision about cameras."""
