"""Checks what each method of a plugin answers, and says what is wrong with it: a module for each kind.

An answer may be handed on as something else that says the same: a generator as a tuple, so that nothing of
it runs later, and an array as one that nobody can alter. A module comes with the first plugin of its kind;
`outward` is that of the kinds that only write or speak.
"""
