<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="en" sourcelanguage="en">
<context>
    <name>PrescriptionClipboard</name>
    <message numerus="yes">
        <source>%n row(s)</source>
        <translation>
            <numerusform>%n row</numerusform>
            <numerusform>%n rows</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%n column(s)</source>
        <translation>
            <numerusform>%n column</numerusform>
            <numerusform>%n columns</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>StopStatistics</name>
    <message numerus="yes">
        <source>%n arm(s) of the starburst</source>
        <translation>
            <numerusform>%n arm of the starburst</numerusform>
            <numerusform>%n arms of the starburst</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%n scratch(es) take %1 %</source>
        <translation>
            <numerusform>%n scratch takes %1 %</numerusform>
            <numerusform>%n scratches take %1 %</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>ghostlight::ConfigurationPanel</name>
    <message numerus="yes">
        <source>%n position(s)</source>
        <translation>
            <numerusform>%n position</numerusform>
            <numerusform>%n positions</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>ghostlight::GlassFoldersDialog</name>
    <message numerus="yes">
        <source>%n catalogue(s) with %1 glasses in these folders; %2 more are bundled.</source>
        <translation>
            <numerusform>%n catalogue with %1 glasses in these folders; %2 more are bundled.</numerusform>
            <numerusform>%n catalogues with %1 glasses in these folders; %2 more are bundled.</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>ghostlight::GlassPanel</name>
    <message numerus="yes">
        <source>%n glass(es)</source>
        <translation>
            <numerusform>%n glass</numerusform>
            <numerusform>%n glasses</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>ghostlight::ImportReportPanel</name>
    <message numerus="yes">
        <source>Nothing here matters for flare. %n line(s) more.</source>
        <translation>
            <numerusform>Nothing here matters for flare. %n line more.</numerusform>
            <numerusform>Nothing here matters for flare. %n lines more.</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>ghostlight::PrescriptionPanel</name>
    <message numerus="yes">
        <source>%n glass(es) not known: mend here</source>
        <translation>
            <numerusform>%n glass is not known: mend it here</numerusform>
            <numerusform>%n glasses are not known: mend them here</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>paste %n cell(s)</source>
        <translation>
            <numerusform>paste a cell</numerusform>
            <numerusform>paste %n cells</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>ghostlight::StatusLine</name>
    <message numerus="yes">
        <source>*%n ghost(s)* · %1 rays · %2 s</source>
        <translation>
            <numerusform>*%n ghost* · %1 rays · %2 s</numerusform>
            <numerusform>*%n ghosts* · %1 rays · %2 s</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source> · %n in the veil</source>
        <translation>
            <numerusform> · %n in the veil</numerusform>
            <numerusform> · %n in the veil</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source> · %n left out ≤ %1 %</source>
        <translation>
            <numerusform> · %n left out ≤ %1 %</numerusform>
            <numerusform> · %n left out ≤ %1 %</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>CPU %1 · %n thread(s)</source>
        <translation>
            <numerusform>CPU %1 · %n thread</numerusform>
            <numerusform>CPU %1 · %n threads</numerusform>
        </translation>
    </message>
</context>
</TS>
