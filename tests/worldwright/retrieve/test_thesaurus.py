"""The thesaurus says the manual's words, and only words the manual has."""

from worldwright.retrieve import thesaurus, words
from worldwright.retrieve.index import open_index


def test_a_symptom_becomes_the_manuals_word():
    assert "restitution" in thesaurus.expand("The ball bounces too little")
    assert "antialiasing" in thesaurus.expand("jagged edges")
    assert thesaurus.expand("xyzzy") == {}
    assert thesaurus.expand("restitution of a bounce") == {}


def test_every_term_occurs_in_the_corpus():
    index = open_index()
    terms = {term for _, meant in thesaurus._rows() for term in meant}
    assert [term for term in sorted(terms) if not index.scores(words.asked(term)).any()] == []
